"""Whether the ego can still arrive, told within bounded work: for a notice, not for a proof on request.

Structure: the forecast without reactions, which shows nearly every way there is; then the search with
reactions (`can_arrive`), given up after so many states. Where there is no way, things whose removal opens the
road are looked for as a certificate does (`sim.oracle.certificate`), with so many looks. Guarantees: what
is answered holds; that there is a way without `ids` was searched. Simplifications: where a bound is met, no
answer, or no such things. The bounds count work and never time, so that the same moment has the same answer
everywhere.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace
from typing import Final

from sim.forecast import Forecast
from sim.oracle.certificate import met_least, opens, thinned
from sim.oracle.lower_bounds import can_arrive, foreseen
from sim.search.reachability import reachability, steps_left
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.types import Outcome, is_ego

STATES: Final = 1_500
"""States that are searched for a way where movers react; a tenth of a second."""

STATES_AHEAD: Final = 100
"""States that are looked at before that by going straight ahead: mostly a fraction of a millisecond."""

STATES_WITHOUT: Final = 300
"""The same for each look at the road without some things."""

LOOKS: Final = 120
"""Looks at the road without some things, on small roads."""

MOST_NAMED: Final = 8
"""More things than this are not named: nobody would remove them one by one."""

LOOKED_OVER: Final = 8_000_000
"""Cells times ticks that all looks may look over, so that there are fewer on large roads."""

QUICK_CELLS: Final = 512
"""On roads up to this size a way is looked for at once, within the ticks that a drive mostly takes."""


@dataclass(frozen=True, slots=True)
class Outlook:
    """Whether a way leads to the goal in time."""

    open: bool
    late: bool = False
    """whether too few ticks are left even for an empty road"""
    ids: tuple[str, ...] = ()
    """things without which there is a way; empty where none were looked for, or found"""
    minimal: bool = False
    """whether without a proper part of them there is none"""


OPEN: Final = Outlook(True)


def quickly_open(state: SimState) -> bool:
    """Whether a way is found within a fraction of a millisecond; where not, there may be one all the same.

    Nothing is looked for at once where there are several egos.
    """
    world, config = state.world, state.config
    road = world.road
    if not config.free_ways_hold or road.columns * road.rows > QUICK_CELLS:
        return False
    limit = min(steps_left(config, world.episode_tick), 3 * road.rows // 2)
    if limit < 1 or world.outcome is not Outcome.RUNNING:
        return False
    if len(world.avs) > 1:  # a way has to be played before it counts
        return False
    forecast = Forecast.of_truth(world, config, limit)
    return reachability(forecast, 1 << forecast.ego, limit).ticks is not None


def outlook(state: SimState, *, ego: str | None = None) -> Outlook | None:
    """Whether an ego (the first by default) can reach the goal from here in time.

    None where that is not found out, as where another ego drives, or where the episode has ended.
    """
    if state.world.outcome is not Outcome.RUNNING:
        return None
    if quickly_open(state):
        return OPEN
    try:
        if can_arrive(state, STATES, ego, states_ahead=STATES_AHEAD):
            return OPEN
    except ImpatientError:
        return None
    forecast, limit = foreseen(state, ego=ego)
    road = forecast.road
    if road.cell(forecast.ego)[1] > limit:
        return Outlook(False, late=True)
    looks = min(LOOKS, LOOKED_OVER // (road.columns * road.rows * limit))
    return _without(state, looks, ego)


@dataclass(slots=True)
class _Looks:
    """Looks at a road without some things; the smallest that opened it is kept."""

    state: SimState
    left: int
    ego: str | None = None
    best: tuple[str, ...] = ()
    sure: bool = True
    """whether every look has had an answer"""
    seen: dict[frozenset[str], bool] = field(default_factory=dict)

    def opens(self, ids: Collection[str]) -> bool:
        """Whether the road is found to be open without these things."""
        gone = frozenset(ids)
        if gone not in self.seen:
            self.seen[gone] = self._look(gone)
            if self.seen[gone] and not 0 < len(self.best) <= len(gone):
                self.best = tuple(sorted(gone, key=_number))
        return self.seen[gone]

    def _look(self, gone: frozenset[str]) -> bool:
        if self.left < 1:
            self.sure = False
            return False
        self.left -= 1
        try:
            return quickly_open(_gone(self.state, gone)) or opens(self.state, gone, self.ego, STATES_WITHOUT)
        except ImpatientError:
            self.sure = False
            return False


def _without(state: SimState, most: int, ego: str | None) -> Outlook:
    """What would have to go."""
    looks = _Looks(state, most, ego)
    candidate: set[str] = set()
    while looks.left > 0:
        egos = frozenset(name for name in candidate if is_ego(name))
        forecast, limit = foreseen(_gone(state, candidate), ego=ego, gone=egos)
        more = met_least(forecast, limit)
        if more <= candidate:
            break  # it is not known to be open, though nothing is met where nobody reacts
        candidate |= more
        if looks.opens(candidate):
            thinned(candidate, looks.opens)
            few = len(looks.best) <= MOST_NAMED
            return Outlook(False, ids=looks.best if few else (), minimal=few and looks.sure)
    return Outlook(False)


def _number(name: str) -> tuple[str, int]:
    kind, _, number = name.rpartition("-")
    return kind, int(number)


def _gone(state: SimState, ids: Iterable[str]) -> SimState:
    return replace(state, world=state.world.without(frozenset(ids)))
