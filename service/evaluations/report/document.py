"""What a report holds, in one language and no format: paragraphs, tables, plots and episodes to look at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from service.evaluations.report.plots import Plot, draw_plots
from service.narration.evaluation import EvaluationWords
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION
from service.version import VERSION as PROGRAM
from sim.evaluate.closeness import TTC_S
from sim.evaluate.spec import DETAILED, Evaluation


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell of a table, and where it leads."""

    text: str
    link: str | None = None


@dataclass(frozen=True, slots=True)
class Table:
    """A table; its first row names the columns."""

    heading: str
    rows: Sequence[Sequence[Cell]]


@dataclass(frozen=True, slots=True)
class Document:
    """A report."""

    language: str
    title: str
    paragraphs: Sequence[str]
    plots: Sequence[Plot]
    no_plots: str | None
    tables: Sequence[Table]
    method: Sequence[str]


def make_document(
    spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords, language: str, base: str = ""
) -> Document:
    """The report of an evaluation. `base`: the address of a service whose page opens the episodes."""
    plots = draw_plots(spec, summary, words)
    tables = [
        _figures(spec, summary, words),
        *_pairs(spec, summary, words),
        *_look(spec, summary, words, base),
    ]
    method = [
        words.label("method", seed=spec.seed, close=min(DETAILED, spec.episodes)),
        words.label("program", version=PROGRAM, rules=spec.config.rules),
    ]
    return Document(
        language=language,
        title=words.title(spec),
        paragraphs=words.paragraphs(spec, summary),
        plots=plots or (),
        no_plots=words.label("no_plots") if plots is None else None,
        tables=tables,
        method=method,
    )


def _figures(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords) -> Table:
    ttc = words.number(TTC_S, "g")
    head = ["runs", "arrived", "interval", "crashed", "interval", "stuck", "interval"]
    head += ["seconds", "interval", "median", "p90", "metres", "moves"]
    names = [words.label("planner"), *(words.label(each) for each in head), words.label("near", ttc=ttc)]
    names += [
        words.label("exposed", ttc=ttc),
        *(words.label(each) for each in ("ttc", "gap", "changes", "lost")),
    ]
    # One line for each figure and a column for each planner: there are more figures than planners.
    columns = [names, *(_column(planner, summary["planners"][planner], words) for planner in spec.planners)]
    return Table(words.label("figures"), [[Cell(text) for text in row] for row in zip(*columns, strict=True)])


def _column(planner: str, figures: Mapping[str, Any], words: EvaluationWords) -> list[str]:
    def interval(of: Mapping[str, Any]) -> str:
        return f"{words.percent(of['low'], 2)}–{words.percent(of['high'], 2)} %"

    cells = [words.planner(planner), words.number(figures["arrived"]["of"], ",")]
    for name in ("arrived", "crashed", "stuck"):
        part = figures[name]
        cells += [f"{words.number(part['count'], ',')} ({words.percent(part['share'], 2)} %)", interval(part)]
    seconds, close = figures["seconds"], figures["close"]
    cells += [
        words.number(seconds["mean"]),
        f"{words.number(seconds['low'])}–{words.number(seconds['high'])}",
        words.number(seconds["median"]),
        words.number(seconds["p90"]),
        words.number(figures["metres"]["mean"], ".1f"),
        " / ".join(f"{words.percent(figures['moves'][name])} %" for name in _MOVES),
        " / ".join(words.number(close["near_misses"][name], ",") for name in ("count", "of")),
        words.number(close["exposed_s"]["mean"]),
        words.number(close["ttc_s"]["median"]),
        words.number(close["gap_m"]["median"]),
        words.number(close["changes_per_10_moves"]),
        words.number(close["lost_s"]["mean"]),
    ]
    return cells


_MOVES = ("forward", "sideways", "diagonal", "stay")


def _pairs(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords) -> list[Table]:
    if not summary["comparisons"]:
        return []
    first = words.planner(spec.planners[0])
    head = [words.label("planner"), words.label("both"), words.label("only", planner=first)]
    head += [words.label("only", planner="↓"), words.label("neither"), words.label("difference")]
    head += [words.label("interval"), words.label("p")]
    rows = [head]
    for pair in summary["comparisons"]:
        counts = [words.number(pair[name], ",") for name in ("both", "only_first", "only_second", "neither")]
        difference = pair["difference"]
        shares = [words.percent(difference[name], 2) for name in ("share", "low", "high")]
        name = f"{first} – {words.planner(pair['second'])}"
        p_value = words.probability(pair["p_value"])
        rows.append([name, *counts, shares[0], f"{shares[1]} … {shares[2]}", p_value])
    return [Table(words.label("pairs"), [[Cell(text) for text in row] for row in rows])]


def _look(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords, base: str) -> list[Table]:
    if not summary["examples"]:
        return []
    head = [words.label(name) for name in ("planner", "seed", "outcome", "ticks")]
    rows = [[Cell(text) for text in (*head, "")]]
    for each in summary["examples"]:
        link = episode_link(spec, each, base)
        rows.append(
            [
                Cell(words.planner(each["planner"])),
                Cell(str(each["seed"])),
                Cell(words.label("outcomes", each["outcome"])),
                Cell(str(each["ticks"])),
                Cell("" if link is None else words.label("open", tick=each["tick"]), link),
            ]
        )
    return [Table(words.label("look"), rows)]


def episode_link(spec: Evaluation, example: Mapping[str, Any], base: str = "") -> str | None:
    """Where the page opens an episode at the tick worth looking at.

    None for one that did not start from its configuration alone, which no link can carry.
    """
    if spec.world is not None:
        return None
    config = replace(spec.config, seed=example["seed"], planner=example["planner"])
    recording = {
        "format": FORMAT,
        "version": VERSION,
        "rules": config.rules,
        "name": None,
        "config": asdict(config),
        "entries": [],
        "tick": example["tick"],
        "digest": example["digest"],
    }
    return f"{base}/{pack_recording(recording)}"
