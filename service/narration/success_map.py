"""Success maps in words: in which region a planner certainly arrives how often, and where it does least."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from service.narration.sayings import Sayings
from sim.config import COUNTS

Json = Mapping[str, Any]
_KINDS = {name: kind for kind, name in COUNTS.items()}


class MapWords:
    """Success maps in one language."""

    def __init__(self, sayings: Sayings, percent: Callable[[float | None], str]) -> None:
        """`percent`: tells a share in per cent."""
        self._sayings = sayings
        self._percent = percent

    def over(self, axes: Sequence[str]) -> str:
        """What the map is drawn over, for headings."""
        return self._say("over", axes=self._sayings.joined([self.axis(name) for name in axes]))

    def axis(self, name: str) -> str:
        """The things that an axis counts."""
        return self._sayings.things(_KINDS[name], 2)

    def paragraphs(self, found: Json) -> Iterator[str]:
        """What the map says of each planner."""
        for planner, drawn in found["planners"].items():
            region, least = (
                self._region(planner, drawn["region"], found),
                self._least(planner, drawn["cells"], found),
            )
            yield f"{region} {least}"

    # Within

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("evaluation", "map", *keys, **parts)

    def _region(self, planner: str, region: Json | None, found: Json) -> str:
        named = self._sayings.planner(planner)
        if region is None:
            return self._say("nowhere", planner=named)
        axes, values = found["axes"], found["values"]
        levels = [values[place][region[side] - 1] for place, side in enumerate(("rows", "columns"))]
        whole = [region["rows"], region["columns"]] == [len(each) for each in values]
        return self._say(
            "everywhere" if whole else "region",
            planner=named,
            limit=self._percent(region["above"]),
            levels=self._sayings.joined([self._up_to(*each) for each in zip(axes, levels, strict=True)]),
        )

    def _up_to(self, name: str, most: int) -> str:
        things = self._sayings.things(_KINDS[name], most)
        return self._say("up_to" if most else "without", things=things, count=most)

    def _least(self, planner: str, rows: Sequence[Sequence[Json]], found: Json) -> str:
        cells = [(row, column) for row, each in enumerate(rows) for column in range(len(each))]
        row, column = min(cells, key=lambda place: rows[place[0]][place[1]]["share"])
        cell, values = rows[row][column], found["values"]
        if cell["count"] == cell["of"]:
            return self._say("all", planner=self._sayings.planner(planner))
        counts = [
            self._counted(name, values[place][at])
            for place, (name, at) in enumerate(zip(found["axes"], (row, column), strict=True))
        ]
        shares = {name: self._percent(cell[name]) for name in ("share", "low", "high")}
        named = self._sayings.planner(planner)
        return self._say("least", planner=named, things=self._sayings.joined(counts), **shares)

    def _counted(self, name: str, count: int) -> str:
        return self._say("counted", things=self._sayings.things(_KINDS[name], count), count=count)
