"""A person's driving beside that of the planner, which drives the same road again from where it began.

Both set out from one state: that in which the person first drove in the present episode. What was said
meanwhile is said to the planner's run as well, at the same ticks; how others react is drawn alike, as far as
both stand alike. Both are compared at the same tick, and both are followed to their end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Final

from sim.actions import Drive, SetMode
from sim.explain.closest_call import closest_call
from sim.explain.driven_again import NotAgainError, drive_again
from sim.explain.effort import prepare
from sim.explain.episode_rollout import MAX_FAULTS, MAX_WORK, EpisodeRollout, decided, story, work_of_tick
from sim.explain.foresight import driving
from sim.explain.planners import planner_of
from sim.explain.question_error import QuestionError
from sim.plan import planner_named, traits_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Outcome

_DRIVING: Final = (SetMode, Drive)


@dataclass(frozen=True, slots=True)
class Stretch:
    """What was driven from the first common tick up to the one that is compared."""

    last: SimState
    rows: int
    """rows nearer to the goal"""
    stops: int
    """stops, however long"""
    changes: int
    """lane changes, diagonals among them"""
    gap_m: float | None
    """the closest that something which moves came without contact; None where nothing came near"""

    @property
    def outcome(self) -> Outcome:
        """How it stands."""
        return self.last.world.outcome

    @property
    def rows_left(self) -> int:
        """Rows to the goal."""
        world = self.last.world
        return world.road.cell(world.av)[1]

    @property
    def clearance(self) -> float:
        """Lower is nearer to others: below 0 on a crash, endless where nothing came near."""
        if self.outcome is Outcome.CRASH:
            return -1.0
        return inf if self.gap_m is None else self.gap_m

    @property
    def unrest(self) -> int:
        """Stops and lane changes."""
        return self.stops + self.changes


@dataclass(frozen=True, slots=True)
class HandBeside:
    """A person's driving, and the planner's in its place."""

    took: int
    """the tick at which the person first drove"""
    now: int
    """the tick at which both are compared"""
    planner: str
    own: bool
    """whether that is the planner of the session"""
    hand: Stretch
    other: Stretch
    hand_end: tuple[Outcome, int]
    """how and at which tick it ends from where the person is, driven by that planner from now on; `running`
    where the end is too far to tell"""
    other_end: tuple[Outcome, int]
    """how and at which tick the planner's run ends"""

    @property
    def progress(self) -> int:
        """1 where the person got further, -1 where the planner did, 0 where neither."""
        return _sign(_place(self.hand) > _place(self.other), _place(self.hand) < _place(self.other))

    @property
    def clearance(self) -> int:
        """The same of the distance kept to what moves."""
        one, other = self.hand.clearance, self.other.clearance
        return _sign(one > other, one < other)

    @property
    def calm(self) -> int:
        """The same of fewer stops and lane changes."""
        one, other = self.hand.unrest, self.other.unrest
        return _sign(one < other, one > other)


def hand_beside(timeline: Timeline, planner: str | None = None) -> HandBeside:
    """The present episode from where a person first drove, beside a planner: by default the session's own.

    Of the first ego. Raises `QuestionError`: `not_by_hand` where nobody has driven in it, `no_such_planner`,
    `too_long_again`, `not_again` where the road was made anew meanwhile, `no_answer` of a planner that gives
    none.
    """
    state = timeline.state
    world = state.world
    last = timeline.tick if world.ended is None else world.ended
    took = _taken_at(timeline, last)
    if took is None:
        raise QuestionError("not_by_hand")
    if planner is not None and planner_named(planner) is None:
        raise QuestionError("no_such_planner", planner=planner)
    start = driving(timeline.at(took))
    own = planner is None or planner == planner_of(start)
    name = planner_of(start) if planner is None else planner
    if planner is not None:
        start = start.with_ego(planner=planner)
    there = _driven_by(timeline, start, last, name)
    here = list(timeline.between(took, last + 1))
    now = there[: last - took + 1]
    end = there[-1].world
    return HandBeside(
        took=took,
        now=last,
        planner=name,
        own=own,
        hand=_stretch(here),
        other=_stretch(now),
        hand_end=_end(here[-1], None if own else planner),
        other_end=(end.outcome, end.tick),
    )


def _taken_at(timeline: Timeline, last: int) -> int | None:
    """The first tick of the episode in which a person drove; None: nobody did."""
    first = timeline.state.world.episode_start
    if not timeline.entries or first >= last:
        return None
    for before in timeline.between(first, last):
        ego = before.ego()
        if ego.queue or ego.mode is Mode.MANUAL:
            return before.world.tick
    return None


def _driven_by(timeline: Timeline, start: SimState, last: int, name: str) -> list[SimState]:
    """Each state of the planner's run to its end."""
    prepare(start)
    states, work, faults = [start], 0, 0
    searches = traits_of(name).plans_to_goal
    try:
        for _, tick in drive_again(timeline, start, last, unsaid=_DRIVING):
            work += work_of_tick(start.world.road) if searches else 0
            decision = decided(tick, None)
            faults = faults + 1 if decision is not None and decision.fault is not None else 0
            late = decision is not None and decision.timed_out
            if decision is not None and (late or faults > MAX_FAULTS):
                raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
            if work > MAX_WORK:
                raise QuestionError("too_long_again")
            states.append(tick.state)
    except NotAgainError as error:
        raise QuestionError("not_again") from error
    return states


def _end(state: SimState, planner: str | None) -> tuple[Outcome, int]:
    """How it ends if a planner drives from here on; None: the one that is set."""
    if state.world.outcome is not Outcome.RUNNING:
        return state.world.outcome, state.world.tick
    then = driving(state)
    told: EpisodeRollout = story(then if planner is None else then.with_ego(planner=planner))
    return told.outcome, told.end


def _stretch(states: Sequence[SimState]) -> Stretch:
    stops = changes = 0
    still = False
    for before, after in pairwise(states):
        column, row = before.world.road.cell(before.world.av)
        stays = (column, row) == after.world.road.cell(after.world.av)
        stops += stays and not still
        still = stays
        changes += after.world.road.cell(after.world.av)[0] != column
    first, last = states[0].world, states[-1].world
    rows = first.road.cell(first.av)[1] - last.road.cell(last.av)[1]
    call = closest_call(states)
    return Stretch(states[-1], rows, stops, changes, None if call is None else call.gap_m)


def _place(stretch: Stretch) -> tuple[bool, int, int]:
    """Higher is further: no crash before one, then fewer rows to go, then an earlier arrival."""
    arrived = stretch.outcome is Outcome.SUCCESS
    return (
        stretch.outcome is not Outcome.CRASH,
        -stretch.rows_left,
        -stretch.last.world.tick if arrived else 0,
    )


def _sign(more: bool, less: bool) -> int:
    return int(more) - int(less)
