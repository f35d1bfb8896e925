"""Where all other road users go, and which of them come into the lane ahead of the ego.

The road is driven on as it stands: the ego as its planner drives, the others by their rules.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from sim.explain.question_error import QuestionError
from sim.rules.mover_boards import PERIODS
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Move, Outcome
from sim.world import Thing

CROSSING_TICKS: Final = 6
"""Ticks in which somebody who comes into the lane is looked for."""
CROSSING_ROWS: Final = 10
"""Rows ahead of the ego in which somebody is looked for."""


@dataclass(frozen=True, slots=True)
class OthersAhead:
    """Where each road user goes with its next step."""

    state: SimState
    ways: tuple[tuple[Thing, Move], ...]
    """each with its next step across; staying where it takes none within the rhythm of its kind"""

    def going(self, move: Move) -> int:
        """How many go there."""
        return sum(way is move for _, way in self.ways)


@dataclass(frozen=True, slots=True)
class Crossing:
    """Who comes into the ego's lane ahead of it."""

    state: SimState
    ticks: int
    """how many ticks were looked ahead: fewer than `CROSSING_TICKS` where the drive ends before"""
    coming: tuple[tuple[str, int], ...]
    """ids, each with the ticks until it is there: 0 where it is there now; the nearest in time first"""


def others_ahead(timeline: Timeline, kind: Kind | None) -> OthersAhead:
    """Where those of a kind, or all, go next. Raises `QuestionError`: `result_stood`."""
    state = _running(timeline)
    movers = _movers(state, kind)
    steps = dict.fromkeys((each.id for each in movers), Move.STAY)
    for ticks, later in enumerate(_driven_on(state, max(PERIODS.values())), start=1):
        for each in movers:
            then = later.world.find(each.id)
            if ticks > PERIODS[each.kind] or then is None or steps[each.id] is not Move.STAY:
                continue
            across = then.cell[0] - each.cell[0]
            if across:
                steps[each.id] = Move.RIGHT if across > 0 else Move.LEFT
    return OthersAhead(state, tuple((each, steps[each.id]) for each in movers))


def others_next(timeline: Timeline, kind: Kind | None) -> OthersAhead:
    """What those of a kind, or all, do in the very next tick, the nearest to the ego first.

    What is drawn for that tick is known by now. Raises `QuestionError`: `result_stood`, `no_answer`.
    """
    state = _running(timeline)
    column, row = state.world.road.cell(state.world.av)
    after = next(_driven_on(state, 1), None)
    if after is None:
        raise QuestionError("no_answer", planner=state.config_of(None).planner, fault="timeout")
    ways = []
    for each in _movers(state, kind):
        then = after.world.find(each.id)
        across = 0 if then is None else then.cell[0] - each.cell[0]
        ways.append((each, Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT))
    ways.sort(key=lambda way: (max(abs(way[0].cell[0] - column), abs(way[0].cell[1] - row)), way[0].id))
    return OthersAhead(state, tuple(ways))


def crossing(timeline: Timeline, kind: Kind | None) -> Crossing:
    """Who of a kind, or of all, comes into the lane that the ego is in now, within the next ticks.

    Raises `QuestionError`: `result_stood`.
    """
    state = _running(timeline)
    lane, row = state.world.road.cell(state.world.av)
    near = [each for each in _movers(state, kind) if row - CROSSING_ROWS <= each.cell[1] < row]
    found = {each.id: 0 for each in near if each.cell[0] == lane}
    ticks = 0
    for later in _driven_on(state, CROSSING_TICKS):
        ticks += 1
        for each in near:
            then = later.world.find(each.id)
            if each.id not in found and then is not None and then.cell[0] == lane:
                found[each.id] = ticks
    rows = {each.id: row - each.cell[1] for each in near}
    ordered = sorted(found.items(), key=lambda each: (each[1], rows[each[0]], each[0]))
    return Crossing(state, ticks, tuple(ordered))


def _running(timeline: Timeline) -> SimState:
    state = timeline.state
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("result_stood", tick=state.world.tick, outcome=state.world.outcome)
    return state


def _movers(state: SimState, kind: Kind | None) -> list[Thing]:
    """Those that move across the road, and are of the kind."""
    return [
        each
        for each in state.world.things()
        if each.heading is not None and each.kind in (kind or each.kind,)
    ]


def _driven_on(state: SimState, ticks: int) -> Iterator[SimState]:
    """The states of the next ticks, as far as the drive goes on."""
    for _ in range(ticks):
        told = step(state)
        if any(each.decision.timed_out for each in told.steps.values()):
            return
        state = told.state
        yield state
        if state.world.outcome is not Outcome.RUNNING:
            return
