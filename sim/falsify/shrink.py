"""Makes a failing world 1-minimal: the planner fails in it, and without any one of its things it arrives.

Delta debugging leaves out what can be spared while the planner still fails and the world can still be driven
(Zeller & Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE Transactions on Software
Engineering, 2002). Without one thing more the planner may still fail in a world that nobody can drive, since
what held a mover is gone; then another thing is left out together with it. A world for which that leads
nowhere is given up, and never shown as minimal.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Final

from sim.evaluate.executor import CancelledError
from sim.falsify.world import Cancelled, outcome_of, solvable, with_only
from sim.oracle.ddmin import ddmin
from sim.state import SimState
from sim.types import Outcome

MAX_CELLS: Final = 1_000_000
"""Most cells of road that are driven on to shrink one world: some 4,000 episodes on a default road."""
LEAST_DRIVES: Final = 200
"""Episodes that may be driven to shrink a world on a road of any size."""


class GivenUpError(Exception):
    """No 1-minimal world was found within the work that one may take."""


class Shrinking:
    """Shrinks one world; each smaller one is driven once."""

    def __init__(self, start: SimState, cancelled: Cancelled = lambda: False) -> None:
        """`start`: the beginning of an episode that fails in a world that can be driven."""
        self._start = start
        self._cancelled = cancelled
        cells = start.world.road.columns * start.world.road.rows
        self._most = max(LEAST_DRIVES, MAX_CELLS // cells)
        self._failing: dict[frozenset[str], bool] = {}
        self._holding: dict[frozenset[str], bool] = {}

    def fails(self, ids: Collection[str]) -> bool:
        """Whether the planner does not arrive with these things alone on the road."""
        key = frozenset(ids)
        if key not in self._failing:
            if self._cancelled():
                raise CancelledError
            if len(self._failing) >= self._most:
                raise GivenUpError
            self._failing[key] = outcome_of(with_only(self._start, key)) is not Outcome.SUCCESS
        return self._failing[key]

    def holds(self, ids: Collection[str]) -> bool:
        """Whether the planner fails with these things alone, and somebody could arrive."""
        key = frozenset(ids)
        if key not in self._holding:
            self._holding[key] = self.fails(key) and solvable(with_only(self._start, key)) is True
        return self._holding[key]

    def minimal(self) -> tuple[str, ...] | None:
        """The things of a 1-minimal world; None where none was found."""
        world = self._start.world
        kept: Sequence[str] = sorted((*world.movers.values(), *world.hazards.values()))
        try:
            while True:
                kept = ddmin(kept, self.holds)
                failing = [name for name in kept if self.fails(_without(kept, name))]
                if not failing:
                    return tuple(kept)
                smaller = self._past(kept, failing)
                if smaller is None:
                    return None
                kept = smaller
        except GivenUpError:
            return None

    def _past(self, kept: Sequence[str], failing: Sequence[str]) -> list[str] | None:
        """A smaller world that fails and can be driven, without one of `failing` and another thing."""
        for name in failing:
            rest = _without(kept, name)
            for other in rest:
                if self.holds(fewer := _without(rest, other)):
                    return fewer
        return None


def _without(names: Sequence[str], name: str) -> list[str]:
    return [each for each in names if each != name]
