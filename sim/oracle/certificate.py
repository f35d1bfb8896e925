"""Can this road be driven? A certificate either way, each of them checked by running it.

`Drivable` carries a plan, played through commit and judge before it is handed out. `Blocked` carries a
minimal set of things whose removal opens the road: it was searched, the road without it was found
drivable, and so was the road without each part of it found not to be (every proper part of sets up to
`MAX_TRIED`, else every part that lacks one member). Taking a thing away can change where movers
go, so nothing is concluded that was not run on the changed road.

The first candidate is the set of things that a way with the fewest collisions meets (0-1 breadth-first
search by sets of cells); where its removal does not open the road, all things are thinned out (Zeller &
Hildebrandt, "Simplifying and isolating failure-inducing input", 2002).

It is about one ego, the first by default. Others that stay are things that may block the road, and are named
by their ids; where another one drives, nothing is certified (`sim.oracle.other_egos`).

Movers that react to the ego, by giving way or by braking, are searched with their reactions
(`sim.search.reactive`), so that both answers are proofs for them as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Final

from sim.forecast import Forecast
from sim.oracle.ddmin import ddmin
from sim.oracle.lower_bounds import can_arrive, foreseen, quickest_plan
from sim.oracle.other_egos import UndeterminedError, arrives, others_standing
from sim.state import SimState
from sim.types import Move, is_ego
from sim.world.grid import Board, bits

MAX_TRIED: Final = 8
"""Sets up to this size have every part of them tried."""


@dataclass(frozen=True, slots=True)
class Drivable:
    """A way of least ticks. Played, it arrives and meets nothing."""

    plan: tuple[Move, ...]

    @property
    def ticks(self) -> int:
        """Ticks it takes."""
        return len(self.plan)


@dataclass(frozen=True, slots=True)
class Blocked:
    """There is no way in time. Without these things there is one; without a part of them there is none."""

    ids: tuple[str, ...]
    minimal: bool
    """whether every proper part was tried; else only the parts that lack one member"""


Certificate = Drivable | Blocked


def certify(state: SimState, *, ego: str | None = None) -> Certificate:
    """Prove that an ego (the first by default) can reach the goal from here, or that it cannot.

    Raises `ValueError` after the end, and `UndeterminedError` where another ego drives.
    """
    forecast, limit = foreseen(state, ego=ego)
    plan = quickest_plan(state, ego=ego)
    if plan is not None:
        if not arrives(state, plan, ego):
            if forecast.egos:
                raise UndeterminedError("hit")
            raise AssertionError("a plan that was searched does not arrive when it is played")
        return Drivable(plan)
    if limit == 0:
        return Blocked((), True)
    return _blocked(state, forecast, limit, ego)


def opens(state: SimState, ids: Iterable[str], ego: str | None = None, patience: int | None = None) -> bool:
    """Whether the goal can be reached once these things and other egos are gone.

    `patience`: as for `sim.oracle.lower_bounds.least_ticks`.
    """
    gone = frozenset(ids)
    egos = frozenset(name for name in gone if is_ego(name))
    return can_arrive(replace(state, world=state.world.without(gone)), patience, ego, egos)


def _blocked(state: SimState, forecast: Forecast, limit: int, ego: str | None) -> Blocked:
    names = sorted({*state.world.movers.values(), *state.world.hazards.values()})
    names += others_standing(state, ego)
    if not opens(state, names, ego):
        return Blocked((), True)  # not even an empty road is long enough in time
    candidate: Iterable[str] = met_least(forecast, limit)
    if not opens(state, candidate, ego):
        candidate = ddmin(names, lambda gone: opens(state, gone, ego))
    return Blocked(*thinned(candidate, lambda gone: opens(state, gone, ego)))


def thinned(candidate: Iterable[str], opens: Callable[[Sequence[str]], bool]) -> tuple[tuple[str, ...], bool]:
    """A minimal part of what opens a road that still does; and whether every proper part of it was tried."""
    kept = ddmin(sorted(candidate), opens)
    if len(kept) > MAX_TRIED:
        return tuple(kept), False
    parts = (part for size in range(1, len(kept)) for part in combinations(kept, size))
    smaller = next((part for part in parts if opens(part)), None)
    return tuple(kept) if smaller is None else smaller, True


def met_least(forecast: Forecast, limit: int) -> set[str]:
    """The things that a way with the fewest collisions meets."""
    goal, any_step = forecast.road.row(0), forecast.dynamics.ends_anywhere
    start = 1 << forecast.ego
    levels: list[list[Board]] = [[start]]
    for ahead in range(limit):
        levels[0].append(forecast.spread(levels[0][-1], ahead))
    while True:
        below, layers = levels[-1], [start]
        for ahead in range(limit):
            layers.append(forecast.spread(layers[-1], ahead) | any_step(below[ahead]))
            if layers[-1] & goal:
                return _traced(forecast, [*levels, layers], len(layers) - 1)
        levels.append(layers)


def _traced(forecast: Forecast, levels: list[list[Board]], tick: int) -> set[str]:
    """Who is met on one way back from the goal through the levels of collisions."""
    level = len(levels) - 1
    cell = next(bits(levels[level][tick] & forecast.road.row(0)))
    met: set[str] = set()
    while tick > 0:
        tick -= 1
        starts = [
            start
            for start in _from(forecast, cell)
            if levels[level][tick] >> start & 1 and forecast.spread(1 << start, tick) >> cell & 1
        ]
        if not starts:
            level -= 1
            starts = [start for start in _from(forecast, cell) if levels[level][tick] >> start & 1]
            met.update(forecast.check_step(starts[0], cell, tick)[1])
        cell = starts[0]
    return met


def _from(forecast: Forecast, cell: int) -> list[int]:
    """The cells from which a move leads into this one."""
    end = 1 << cell
    return list(bits(forecast.dynamics.may_come_from(end, end)))
