"""The report of a search for failures: its generations, and the cases with links that open them."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from io import StringIO
from typing import Any

from service.evaluations.report.document import Cell, Document, Table
from service.narration.falsification import FalsificationWords
from service.version import VERSION as PROGRAM
from sim.falsify import Falsification
from sim.falsify.space import KINDS_SEARCHED, LAYOUTS
from sim.falsify.stages import SearchPiece, unpack

Result = Mapping[str, Any]


def make_failure_document(
    spec: Falsification, result: Result, words: FalsificationWords, language: str, base: str = ""
) -> Document:
    """The report of a search. `base`: the address of a service whose page opens the cases."""
    return Document(
        language=language,
        title=words.title(spec),
        paragraphs=words.paragraphs(spec, result),
        plots=(),
        no_plots=None,
        tables=[*_cases(result, words, base), _generations(result, words)],
        method=[
            words.label("method", seed=spec.seed),
            words.label("program", version=PROGRAM, rules=spec.config.rules),
        ],
    )


def _cases(result: Result, words: FalsificationWords, base: str) -> list[Table]:
    if not result["cases"]:
        return []
    names = ("name", "seed", "outcome", "ticks", "way", "things", "before")
    rows = [[Cell(text) for text in (*(words.label(name) for name in names), "")]]
    for each in result["cases"]:
        texts = (
            each["case"]["name"],
            str(each["seed"]),
            words.label("outcomes", each["outcome"]),
            str(each["ticks"]),
            str(each["least"]),
            words.things(each["things"]),
            str(each["things_before"]),
        )
        link = each.get("link")
        opened = Cell(
            "" if link is None else words.label("open", tick=each["tick"]), link and f"{base}/{link}"
        )
        rows.append([*(Cell(text) for text in texts), opened])
    return [Table(words.label("cases"), rows)]


def _generations(result: Result, words: FalsificationWords) -> Table:
    names = ("generation", "drawn", "worlds", "failed", "interval", "densities")
    rows = [[Cell(words.label(name)) for name in names]]
    for number, each in enumerate(result["generations"]):
        failed = each["failed"]
        directed = number > 0 and result["directed"] is not None
        densities = ", ".join(f"{kind} {100 * level:.0f}" for kind, level in each["levels"].items())
        texts = (
            str(number + 1),
            words.label("directed" if directed else "random"),
            str(failed["of"]),
            str(failed["count"]),
            f"{100 * failed['low']:.1f}–{100 * failed['high']:.1f} %",
            densities,
        )
        rows.append([Cell(text) for text in texts])
    return Table(words.label("generations"), rows)


def write_worlds(spec: Falsification, parts: Mapping[str, bytes]) -> str:
    """A line for each world that was looked at."""
    buffer = StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    kinds = [kind.value for kind in KINDS_SEARCHED]
    writer.writerow(("world", "seed", "generation", "finding", "ticks", "things", "layout", *kinds))
    for stretches in spec.stretches():
        for stretch in stretches:
            for each in unpack(parts[SearchPiece(stretch, None).key]):
                layout = LAYOUTS[each.point.layout] or ""
                values = (each.index, spec.seed + each.index, stretch.generation, each.finding.value)
                writer.writerow((*values, each.ticks, each.things, layout, *each.point.levels))
    return buffer.getvalue()
