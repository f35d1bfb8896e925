"""What a report holds, in one language and no format: paragraphs, tables, plots and episodes to look at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from service.actions import dump
from service.evaluations.report.figures import (
    Behind,
    Cell,
    Table,
    cases_table,
    example_name,
    figures_table,
    pairs_table,
)
from service.evaluations.report.plots import Plot, draw_plots
from service.evaluations.report.success_map import map_tables
from service.narration.evaluation import EvaluationWords
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION
from service.version import VERSION as PROGRAM
from sim.evaluate.failures import most_of
from sim.evaluate.spec import Evaluation

__all__ = ["Cell", "Document", "Table", "episode_link", "make_document"]


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
    behind = Behind(summary["examples"])
    plots = draw_plots(spec, summary, words, behind)
    tables = [
        *map_tables(summary, words, behind),
        *cases_table(spec, summary, words, behind),
        figures_table(spec, summary, words, behind),
        *pairs_table(spec, summary, words, behind),
        *_look(spec, summary, words, base),
    ]
    method = [
        words.label("drawn" if spec.world is None else "driven", told=words.whole(spec.config)),
        words.label(
            "method" if spec.world is None else "method_this",
            seed=spec.seed,
            close=min(spec.detailed, spec.episodes),
        ),
        *([words.label("method_cases")] if spec.cases else []),
        *([words.label("method_map")] if spec.axes else []),
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


def _look(spec: Evaluation, summary: Mapping[str, Any], words: EvaluationWords, base: str) -> list[Table]:
    if not summary["examples"]:
        return []
    cases = summary.get("cases", ())
    names = ["planner", *(["condition"] if cases else []), "seed", "outcome", "ticks", "shows"]
    rows = [[*(Cell(words.label(name)) for name in names), Cell("")]]
    for number, each in enumerate(summary["examples"]):
        link = episode_link(spec, each, base)
        condition = [Cell(words.condition(cases[each["case"]]["said"]))] if cases else []
        rows.append(
            [
                Cell(words.planner(each["planner"]), name=example_name(number)),
                *condition,
                Cell(str(each["seed"])),
                Cell(words.label("outcomes", each["outcome"])),
                Cell(str(each["ticks"])),
                Cell(words.shows(each)),
                Cell("" if link is None else words.label("open", tick=each["tick"]), link),
            ]
        )
    one_road = "legend_this" if spec.scenario_name is None else "legend_its"
    key = "legend" if spec.world is None else one_road
    return [Table(words.label("look"), rows, words.label(key, most=most_of(spec)))]


def episode_link(spec: Evaluation, example: Mapping[str, Any], base: str = "") -> str | None:
    """Where the page opens an episode at the tick worth looking at.

    None for one that did not start from its configuration alone, which no link can carry.
    """
    if spec.world is not None:
        return None
    alone = spec.under(example["case"]) if spec.cases else spec
    config = replace(alone.config, seed=example["seed"], planner=example["planner"])
    recording = {
        "format": FORMAT,
        "version": VERSION,
        "rules": config.rules,
        "name": None,
        "config": asdict(config),
        "entries": _rules(alone),
        "tick": example["tick"],
        "digest": example["digest"],
    }
    return f"{base}/{pack_recording(recording)}"


def _rules(spec: Evaluation) -> list[dict[str, Any]]:
    """The rules of every episode as an entry of a recording."""
    if not spec.rules:
        return []
    return [{"sequence": 1, "tick": 0, "text": None, "actions": dump(spec.rules)}]
