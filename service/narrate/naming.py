"""Things as the driver would point at them: "the pothole ahead", "the car in the second lane to my left".

Lanes and metres from the vehicle's seat name one cell each, so no two things of a kind have one name. Ids
belong in the structured part of an answer. Words are data (`naming.yaml`).
"""

from __future__ import annotations

from collections.abc import Sequence

from service.narrate.sayings import Sayings
from sim.kinds import Cell
from sim.road import Road
from sim.run import Run


class Naming:
    """Names in one language, as seen in one moment."""

    def __init__(self, sayings: Sayings, run: Run) -> None:
        """`run`: the moment; the vehicle stands where it stood then."""
        self._sayings = sayings
        self._world = run.world
        self._cell_m = run.config.cell_m

    def thing(self, name: str) -> str:
        """The thing with this id, with its article: "the pothole ahead". An id no longer there is itself."""
        found = self._world.find(name)
        if found is None:
            return name
        noun = self._sayings.say("naming", "the", found.kind)
        return self._sayings.say("naming", "thing", noun=noun, place=self._place(found.cell))

    def things(self, names: Sequence[str]) -> str:
        """Several things, each named: "the pothole ahead and the car on my left"."""
        return self._sayings.joined([self.thing(name) for name in names])

    def place(self, cell: Cell) -> str:
        """A cell as seen from the vehicle: "right ahead", "10 m ahead on my left"."""
        return self._place(cell)

    def _place(self, cell: Cell) -> str:
        column, row = self._seat(self._world.road)
        across, along = cell[0] - column, row - cell[1]
        parts = [self._metres(along, beside=across != 0), self._lanes(across)]
        return self._sayings.say("naming", "apart").join(part for part in parts if part)

    def _lanes(self, across: int) -> str:
        if across == 0:
            return ""
        side = "left" if across < 0 else "right"
        count = abs(across)
        return self._sayings.say("naming", side, "one" if count == 1 else "many", nth=self._nth(count))

    def _metres(self, along: int, *, beside: bool) -> str:
        if along == 0:
            return "" if beside else self._sayings.say("naming", "here")
        side = "ahead" if along > 0 else "behind"
        if abs(along) == 1 and not beside:
            return self._sayings.say("naming", side, "next")
        return self._sayings.say("naming", side, "metres", metres=f"{abs(along) * self._cell_m:g}")

    def _nth(self, count: int) -> str:
        words = self._sayings.words("naming", "places")
        return str(words[count]) if count < len(words) else self._sayings.say("naming", "nth", count=count)

    def _seat(self, road: Road) -> Cell:
        return road.cell(self._world.av)
