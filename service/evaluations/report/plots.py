"""The plots of a report as SVG, drawn by matplotlib where that is installed (the extra `evaluate`)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from typing import TYPE_CHECKING, Any, Final

from service.evaluations.report.figures import Behind
from service.evaluations.report.success_map import draw_map
from service.narration.evaluation import EvaluationWords
from sim.evaluate.spec import Evaluation

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS: Final = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
"""Colours that people with any colour vision can tell apart (Okabe & Ito, 2008)."""
WIDTH_IN: Final = 7.2


@dataclass(frozen=True, slots=True)
class Plot:
    """A plot; `alt` says what it shows to those who cannot see it."""

    title: str
    alt: str
    svg: str


def draw_plots(
    spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords, behind: Behind
) -> list[Plot] | None:
    """The plots; None where matplotlib is not installed. Of runs that are all the same there are none."""
    if spec.alike:
        return []
    try:
        import matplotlib
    except ImportError:
        return None
    # Text stays text, and the same figures make the same file.
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "roadtalk", "font.size": 10}):
        plots = [Plot(words.label("rates"), words.label("rates_alt"), _rates(spec, summary, words))]
        if spec.axes is not None:
            maps = summary["map"]
            plots = [
                Plot(
                    words.label("map_of", planner=words.planner(planner)),
                    words.label("map_alt", planner=words.planner(planner)),
                    _svg(draw_map(maps, planner, words, behind)),
                )
                for planner in spec.planners
            ] + plots
        elif spec.cases:
            plots.append(
                Plot(words.label("by_case"), words.label("by_case_alt"), _cases(spec, summary, words))
            )
        if any(summary["planners"][planner]["ticks"] for planner in spec.planners):
            plots.append(Plot(words.label("times"), words.label("times_alt"), _times(spec, summary, words)))
    return plots


def _rates(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords) -> str:
    """A point with its interval for each way to end and each planner."""
    rows = [
        (words.label(end), [summary["planners"][planner][end] for planner in spec.planners])
        for end in ("arrived", "crashed", "stuck")
    ]
    return _points(spec, words, rows)


def _cases(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords) -> str:
    """The share that arrived with its interval, for each condition and planner."""
    rows = [
        (words.condition(case["said"]), [case["planners"][planner]["arrived"] for planner in spec.planners])
        for case in summary["cases"]
    ]
    return _points(spec, words, rows)


def _points(
    spec: Evaluation, words: EvaluationWords, rows: Sequence[tuple[str, Sequence[Mapping[str, Any]]]]
) -> str:
    """Shares with their intervals: a group for each row, a colour for each planner."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH_IN, 0.7 + 0.35 * len(rows) * len(spec.planners)), layout="constrained")
    axes = figure.subplots()
    ticks, labels = [], []
    for row, (name, shares) in enumerate(rows):
        for place, part in enumerate(shares):
            at = -(row * (len(spec.planners) + 0.6) + place)
            low, share, high = (100 * part[edge] for edge in ("low", "share", "high"))
            axes.errorbar(
                [share], [at], xerr=[[share - low], [high - share]], fmt="o", color=COLOURS[place], capsize=3
            )
            ticks.append(at)
            labels.append(f"{name} · {words.planner(spec.planners[place])}")
    axes.set_yticks(ticks, labels)
    axes.set_xlim(-2, 102)
    axes.set_xlabel("%")
    axes.grid(axis="x", alpha=0.3)
    return _svg(figure)


def _times(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords) -> str:
    """The share of arrivals that took so long, for each planner."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH_IN, 2.8), layout="constrained")
    axes = figure.subplots()
    for place, planner in enumerate(spec.planners):
        counts = summary["planners"][planner]["ticks"]
        total = sum(count for _, count in counts)
        if not total:
            continue
        first, last = counts[0][0], counts[-1][0]
        shares = dict(counts)
        seconds = [tick * spec.config.step_seconds for tick in range(first, last + 1)]
        heights = [100 * shares.get(tick, 0) / total for tick in range(first, last + 1)]
        axes.step(seconds, heights, where="mid", color=COLOURS[place], label=words.planner(planner))
    axes.set_xlabel(words.label("seconds_axis"))
    axes.set_ylabel("%")
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    return _svg(figure)


def _svg(figure: Figure) -> str:
    """The figure as an element for a page: without the XML declaration, as wide as there is room."""
    buffer = StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None}, transparent=True)
    svg = buffer.getvalue()
    svg = svg[svg.index("<svg") :]
    return re.sub(r'<svg ([^>]*?)height="[^"]*"([^>]*?)width="[^"]*"', r"<svg \1\2", svg, count=1)
