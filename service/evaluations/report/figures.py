"""The tables of a report, and which episodes stand behind each of their figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from service.narration.evaluation import EvaluationWords
from sim.evaluate.closeness import TTC_S
from sim.evaluate.spec import Evaluation
from sim.types import Outcome

Json = Mapping[str, Any]

_OUTCOMES: Final = {"crashed": Outcome.CRASH, "stuck": Outcome.STUCK}
_MOVES: Final = ("forward", "sideways", "diagonal", "stay")


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell of a table: where it leads, and by which name links lead to it."""

    text: str
    link: str | None = None
    name: str | None = None


@dataclass(frozen=True, slots=True)
class Table:
    """A table; its first row names the columns."""

    heading: str
    rows: Sequence[Sequence[Cell]]
    note: str | None = None


def example_name(number: int) -> str:
    """The name of an example's row."""
    return f"episode-{number}"


class Behind:
    """The examples behind figures; links to their rows."""

    def __init__(self, examples: Sequence[Json]) -> None:
        """`examples`: those of the summary, in the order of their rows."""
        self._examples = examples

    def find(self, planner: str, shows: str, case: int | None = None) -> str | None:
        """A link to the first episode behind a figure of a planner; None where there is none."""
        for number, each in enumerate(self._examples):
            if each["planner"] != planner or (case is not None and each.get("case") != case):
                continue
            if shows in each.get("shows", ()) or each["outcome"] == _OUTCOMES.get(shows):
                return f"#{example_name(number)}"
        return None


def figures_table(spec: Evaluation, summary: Json, words: EvaluationWords, behind: Behind) -> Table:
    """One line for each figure and a column for each planner: there are more figures than planners.

    Runs that are all the same are no sample, so that there are no intervals.
    """
    names = [Cell(name) for name in _names(words)]
    columns = [names]
    columns += [
        list(_column(planner, summary["planners"][planner], words, behind)) for planner in spec.planners
    ]
    rows, interval = list(zip(*columns, strict=True)), words.label("interval")
    return Table(
        words.label("figures"), [row for row in rows if not (spec.alike and row[0].text == interval)]
    )


def _names(words: EvaluationWords) -> list[str]:
    ttc = words.number(TTC_S, "g")
    head = ["planner", "runs", "arrived", "interval", "crashed", "interval", "stuck", "interval"]
    head += ["seconds", "interval", "median", "p90", "metres", "moves"]
    names = [words.label(each) for each in head] + [words.label("near", ttc=ttc)]
    return [*names, words.label("exposed", ttc=ttc), *map(words.label, ("ttc", "gap", "changes", "lost"))]


def _column(planner: str, figures: Json, words: EvaluationWords, behind: Behind) -> Iterator[Cell]:
    def to(shows: str) -> str | None:
        return behind.find(planner, shows)

    yield Cell(words.planner(planner))
    yield Cell(words.number(figures["arrived"]["of"], ","))
    for name in ("arrived", "crashed", "stuck"):
        yield _share(figures[name], words, to(name))
        yield Cell(_interval(figures[name], words))
    seconds, close = figures["seconds"], figures["close"]
    near = close["near_misses"]
    yield Cell(words.number(seconds["mean"]), to("arrived"))
    yield Cell(
        "–" if seconds["mean"] is None else f"{words.number(seconds['low'])}–{words.number(seconds['high'])}"
    )
    yield Cell(words.number(seconds["median"]), to("arrived"))
    yield Cell(words.number(seconds["p90"]), to("slowest"))
    yield Cell(words.number(figures["metres"]["mean"], ".1f"), to("arrived"))
    moves = " / ".join(f"{words.percent(figures['moves'][name])} %" for name in _MOVES)
    yield Cell(moves, to("changes"))
    yield Cell(
        " / ".join(words.number(near[name], ",") for name in ("count", "of")),
        to("ttc") if near["count"] else None,
    )
    yield Cell(words.number(close["exposed_s"]["mean"]), to("exposed"))
    yield Cell(words.number(close["ttc_s"]["median"]), to("ttc"))
    yield Cell(words.number(close["gap_m"]["median"]), to("gap"))
    yield Cell(words.number(close["changes_per_10_moves"]), to("changes"))
    yield Cell(words.number(close["lost_s"]["mean"]), to("lost"))


def cases_table(spec: Evaluation, summary: Json, words: EvaluationWords, behind: Behind) -> list[Table]:
    """A line for each condition and planner; nothing where there is one condition."""
    if not summary.get("cases"):
        return []
    head = ("condition", "planner", "runs", "arrived", "interval", "crashed", "stuck", "seconds")
    rows = [[Cell(words.label(name)) for name in head]]
    for number, case in enumerate(summary["cases"]):
        for planner in spec.planners:
            figures = case["planners"][planner]
            shares = [
                _share(figures[name], words, behind.find(planner, name, number))
                for name in ("arrived", "crashed", "stuck")
            ]
            rows.append(
                [
                    Cell(words.condition(case["said"])),
                    Cell(words.planner(planner)),
                    Cell(words.number(figures["arrived"]["of"], ",")),
                    shares[0],
                    Cell(_interval(figures["arrived"], words)),
                    *shares[1:],
                    Cell(words.number(figures["seconds"]["mean"]), behind.find(planner, "arrived", number)),
                ]
            )
    return [Table(words.label("conditions"), rows)]


def pairs_table(spec: Evaluation, summary: Json, words: EvaluationWords, behind: Behind) -> list[Table]:
    """Each other planner compared with the first, run by run, under each condition."""
    if len(spec.planners) < 2:
        return []
    first = words.planner(spec.planners[0])
    head = [words.label("planner"), words.label("both"), words.label("only", planner=first)]
    head += [words.label("only_other"), words.label("neither"), words.label("difference")]
    head += [words.label("interval"), words.label("p")]
    rows = [[Cell(name) for name in head]]
    for number, each in enumerate(summary.get("cases") or (summary,)):
        under = f" ({words.condition(each['said'])})" if spec.cases else ""
        case = number if spec.cases else None
        rows += [_pair(pair, under, words, behind, case) for pair in each["comparisons"]]
    if spec.alike:
        rows = [row[:-2] for row in rows]
    return [Table(words.label("pairs"), rows)]


def _pair(pair: Json, under: str, words: EvaluationWords, behind: Behind, case: int | None) -> list[Cell]:
    first, second = pair["first"], pair["second"]
    counts = [words.number(pair[name], ",") for name in ("both", "only_first", "only_second", "neither")]
    links = [
        behind.find(second, "arrived", case),
        behind.find(second, "only_first", case),
        behind.find(first, f"only_{second}", case),
        None,
    ]
    difference = pair["difference"]
    shares = [words.percent(difference[name], 2) for name in ("share", "low", "high")]
    counted = [Cell(text, link) for text, link in zip(counts, links, strict=True)]
    name = Cell(f"{words.planner(first)} – {words.planner(second)}{under}")
    p_value = Cell(words.probability(pair["p_value"]))
    return [name, *counted, Cell(shares[0]), Cell(f"{shares[1]} … {shares[2]}"), p_value]


def _share(share: Json, words: EvaluationWords, link: str | None) -> Cell:
    text = f"{words.number(share['count'], ',')} ({words.percent(share['share'], 2)} %)"
    return Cell(text, link if share["count"] else None)


def _interval(share: Json, words: EvaluationWords) -> str:
    return f"{words.percent(share['low'], 2)}–{words.percent(share['high'], 2)} %"
