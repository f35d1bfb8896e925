"""Since when no way to the goal has been left, which move gave up the last one, and what was known of it.

Once no way is left none opens again while the road is left alone, as a way of a later moment is one of an
earlier moment too. So the first tick without one is found by halves, each searched on the road as it was:
what `sim.oracle.outlook` leaves open is searched on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from sim.explain.ahead import way
from sim.explain.crash import is_detected
from sim.explain.pattern import move_between
from sim.explain.question_error import QuestionError
from sim.forecast import Forecast
from sim.oracle.lower_bounds import can_arrive
from sim.oracle.outlook import STATES_AHEAD, Outlook, outlook, quickly_open
from sim.plan import Measure
from sim.search.dead_ends import cells_that_may_arrive
from sim.search.reachability import steps_left
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome

STATES: Final = 15_000
"""States that are searched for a way at one tick: ten times as many as for a notice, about a second."""
LOOK_BACK: Final = 12
"""Ticks before the first one without a way in which one with a way is looked for."""


@dataclass(frozen=True, slots=True)
class LostWay:
    """Since when no way has been left, in facts."""

    state: SimState
    """where the ego got no further; the present moment of a drive that goes on"""
    first: int
    """the first tick that was looked at: mostly that of the drive"""
    open: bool | None
    """whether a way was left there; None where that was not found out"""
    plan: tuple[Move, ...] | None
    """the quickest way where one was left"""
    shut_at: SimState | None
    """the first state without a way"""
    shut: Outlook | None
    """what would have to go there"""
    last_open: SimState | None
    """the last state in which a way was found; None where none was"""
    made: Move | None
    """the move that was made there"""
    instead: Move | None
    """the move with which a quickest way went on there"""
    detected: int | None
    """the first tick at which all that would have to go was detected; None where it never was"""
    noticed: int | None
    """the first tick at which the planner itself found no way; None where it never did"""

    @property
    def exact(self) -> bool:
        """Whether the last tick with a way and the first without one are next to each other."""
        one, other = self.last_open, self.shut_at
        return one is not None and other is not None and one.world.tick + 1 == other.world.tick


def lost_way(timeline: Timeline) -> LostWay:
    """Since when the first ego has had no way to the goal in its present drive.

    Raises `QuestionError`: `ended_otherwise` where the drive has ended, and not stuck.
    """
    world = timeline.state.world
    if world.outcome not in (Outcome.RUNNING, Outcome.STUCK):
        raise QuestionError("ended_otherwise", outcome=world.outcome, tick=world.ended or world.tick)
    states = _alike(timeline)
    road = world.road
    ends = states
    if world.outcome is Outcome.STUCK:
        at = min(range(len(states)), key=lambda each: road.cell(states[each].world.av)[1])
        ends = states[: at + 1]
    last = ends[-1]
    known = _open(last)
    if known is not False:
        return LostWay(last, states[0].world.tick, known, way(last) if known else None, *(None,) * 7)
    shut = _first_shut(ends)
    opened = next((at for at in reversed(range(max(0, shut - LOOK_BACK), shut)) if _open(ends[at])), None)
    seen = outlook(ends[shut])
    made = instead = None
    if opened is not None:
        made = move_between(ends[opened], ends[opened + 1])
        plan = way(ends[opened])
        instead = plan[0] if plan else None
    ids = () if seen is None else seen.ids
    return LostWay(
        last,
        states[0].world.tick,
        False,
        None,
        ends[shut],
        seen,
        None if opened is None else ends[opened],
        made,
        instead,
        _detected(timeline, states, ids),
        _noticed(timeline, states[shut:]),
    )


def _alike(timeline: Timeline) -> list[SimState]:
    """The states of the drive, up to the last in which it went on, since the road was last changed."""
    now = timeline.state.world
    stop = now.tick + 1 if now.ended is None else now.ended
    found: list[SimState] = []
    for state in reversed(list(timeline.between(now.episode_start, stop))):
        if state.world.outcome is not Outcome.RUNNING:
            continue
        if found and (state.edits, state.config) != (found[0].edits, found[0].config):
            break
        found.insert(0, state)
    if not found:
        raise QuestionError("nothing_yet", tick=now.tick)
    return found


def _open(state: SimState) -> bool | None:
    """Whether a way is left; None where the search becomes too long."""
    world, config = state.world, state.config
    if quickly_open(state):
        return True
    limit = steps_left(config, world.episode_tick)
    alone = len(world.avs) == 1
    if limit < 1:
        return False
    if alone and not cells_that_may_arrive(Forecast.of_truth(world, config, limit), limit)[0] >> world.av & 1:
        return False
    try:
        return can_arrive(state, STATES, states_ahead=STATES_AHEAD)
    except ImpatientError:
        return None


def _first_shut(states: Sequence[SimState]) -> int:
    """The first of these that is known to have no way; the last one is."""
    low, high = 0, len(states) - 1
    while low < high:
        middle = (low + high) // 2
        if _open(states[middle]) is False:
            high = middle
        else:
            low = middle + 1
    return high


def _detected(timeline: Timeline, states: Sequence[SimState], ids: Sequence[str]) -> int | None:
    """The first tick since which all of these things had been detected once."""
    missing = set(ids)
    for state in states if ids else ():
        taken = timeline.taken(state, state.ego().id)
        if taken is None:
            return None
        missing -= {each for each in missing if is_detected(taken.percept, state.world, each)}
        if not missing:
            return state.world.tick
    return None


def _noticed(timeline: Timeline, states: Sequence[SimState]) -> int | None:
    """The first tick at which a planner that looks to the goal found no way."""
    for state in states:
        decision = timeline.decided(state)
        if decision is None or decision.asked is not None or decision.fault is not None:
            continue
        if decision.measure in (Measure.COST, Measure.TICKS) and decision.chosen.cost is None:
            return state.world.tick
    return None
