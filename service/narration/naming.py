"""Things as the driver would point at them: "the pothole ahead", "the car in the second lane to my left".

Lanes and metres from the vehicle's seat name one cell each, so no two things of a kind have one name. Ids
belong in the structured part of an answer. Words are data (`naming.yaml`).

Where sensors err, a thing is pointed at where it is seen, or where it is: `as_seen` says which comes first.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from functools import lru_cache

from service.narration.sayings import Sayings
from sim.decide import sense
from sim.perceive import sensor_named
from sim.state import SimState
from sim.types import Cell, Kind


class Naming:
    """Names in one language, as seen in one moment."""

    def __init__(
        self, sayings: Sayings, run: SimState, *, as_seen: bool = True, ego: str | None = None
    ) -> None:
        """`run`: the moment; the vehicle (`ego`, the first by default) stands where it stood then."""
        self._sayings = sayings
        self._percept = None if sensor_named(run.config.sensor).faithful else sense(run, id=ego)[0]
        self._as_seen = as_seen
        self._world = run.world
        self._own = run.world.avs[run.number(ego)]
        self._cell_m = run.config.cell_m

    def thing(self, name: str) -> str:
        """The thing with this id, with its article: "the pothole ahead". An id no longer there is itself."""
        found = self._find(name)
        return name if found is None else _thing(self._sayings, found[1], *self._seen(found[0]))

    def things(self, names: Sequence[str]) -> str:
        """Several things, each named: "the pothole ahead and the car on my left"."""
        return self._sayings.joined([self.thing(name) for name in names])

    def place(self, cell: Cell) -> str:
        """A cell as seen from the vehicle: "right ahead", "10 m ahead on my left"."""
        return _place(self._sayings, *self._seen(self._world.road.index(cell)))

    def kinds_and_places(self, names: Sequence[str]) -> Hashable | None:
        """All that the names of these things are made of; None if one is not there any more."""
        found = [self._find(name) for name in names]
        return tuple([each and (each[1], self._seen(each[0])) for each in found]) if all(found) else None

    def imagined(self, names: Sequence[str]) -> dict[str, str]:
        """Those of these things that were seen where they were not, and where that was."""
        if self._percept is None or not self._as_seen:
            return {}
        found: dict[str, str] = {}
        for name in names:
            seen, there = self._percept.find(name), self._world.find(name)
            if seen is not None and (there is None or (there.kind, there.cell) != (seen.kind, seen.cell)):
                found[name] = self.place(seen.cell)
        return found

    def _find(self, name: str) -> tuple[int, Kind] | None:
        """The cell index of a thing and its kind."""
        there = self._world.index_of(name)
        if self._percept is None or (there is not None and not self._as_seen):
            return there
        seen = self._percept.find(name)
        return there if seen is None else (self._world.road.index(seen.cell), seen.kind)

    def _seen(self, index: int) -> tuple[int, int, float]:
        """How far across and along a cell lies from the vehicle, in cells, and how long a cell is."""
        columns, av = self._world.road.columns, self._own
        return index % columns - av % columns, av // columns - index // columns, self._cell_m


@lru_cache(maxsize=4_096)
def _thing(sayings: Sayings, kind: Kind, across: int, along: int, cell_m: float) -> str:
    noun = sayings.say("naming", "the", kind)
    return sayings.say("naming", "thing", noun=noun, place=_place(sayings, across, along, cell_m))


def _place(sayings: Sayings, across: int, along: int, cell_m: float) -> str:
    parts = [_metres(sayings, along, cell_m, beside=across != 0), _lanes(sayings, across)]
    return sayings.say("naming", "apart").join(part for part in parts if part)


def _lanes(sayings: Sayings, across: int) -> str:
    if across == 0:
        return ""
    side = "left" if across < 0 else "right"
    count = abs(across)
    return sayings.say("naming", side, "one" if count == 1 else "many", nth=_nth(sayings, count))


def _metres(sayings: Sayings, along: int, cell_m: float, *, beside: bool) -> str:
    if along == 0:
        return "" if beside else sayings.say("naming", "here")
    side = "ahead" if along > 0 else "behind"
    if abs(along) == 1 and not beside:
        return sayings.say("naming", side, "next")
    return sayings.say("naming", side, "metres", metres=sayings.number(abs(along) * cell_m))


def _nth(sayings: Sayings, count: int) -> str:
    words = sayings.words("naming", "places")
    return str(words[count]) if count < len(words) else sayings.say("naming", "nth", count=count)
