"""The present drive up to now, driven again from its start with something otherwise.

That is planner, sensor, weather or light, or that there is no courtesy or no noise. The seed is the same, and
what people said meanwhile is said again at the same ticks, without settings of what is varied. A
drive that has ended is followed to the end of the other one; of one that goes on, both are compared at the
same tick.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from sim.explain.driven_again import NotAgainError, drive_again
from sim.explain.effort import prepare
from sim.explain.episode_rollout import MAX_FAULTS, MAX_WORK, work_of_tick
from sim.explain.question_error import QuestionError
from sim.explain.weather_effect import OtherMove
from sim.plan import planner_named, traits_of
from sim.session.timeline import Timeline
from sim.state import SimState, StepResult
from sim.types import Kind, Outcome


@dataclass(frozen=True, slots=True)
class SoFar:
    """The drive so far beside the same one with something otherwise, for the first ego."""

    varied: Mapping[str, str | float]
    moves: int
    """moves of the real drive"""
    compared: int
    """moves of it that the other one made as well, or differently: fewer where that one has ended sooner"""
    by_hand: bool
    """whether a person made any of them"""
    differs: OtherMove | None
    """the first move that is another one; None where none is"""
    end: int
    """the tick at which both are compared: now, or that of the end of the real drive"""
    outcome: Outcome
    """how the other one stands then; where the real one has ended, how the other ends"""
    tick: int
    """the tick of that"""
    hit: Kind | None
    """what it crashed into"""
    rows: int
    """rows by which the other one is nearer to the goal at `end`; negative: farther"""

    @property
    def same(self) -> bool:
        """Whether every move is the same one."""
        return self.differs is None and self.compared == self.moves


def so_far(timeline: Timeline, varied: Mapping[str, str | float]) -> SoFar:
    """The present episode with other settings.

    `varied`: of planner, sensor, weather, time of day, courtesy or noise.

    Raises `QuestionError`: `nothing_yet` before the first move, and as `driven_otherwise` does; `ConfigError`
    for values that cannot be.
    """
    world = timeline.state.world
    end = timeline.tick if world.ended is None else world.ended
    if end == world.episode_start:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    stop = end if world.ended is None else None
    others = driven_otherwise(timeline, varied, stop)
    differs: OtherMove | None = None
    by_hand, count = False, 0
    other = compared = timeline.at(world.episode_start)
    for there in timeline.between(world.episode_start, end):
        made = timeline.decided(there)
        by_hand = by_hand or (made is not None and made.asked is not None)
        tick = next(others, None)
        if tick is None:
            continue  # the other one has ended sooner
        other = compared = tick.state
        count += 1
        would = tick.decision
        if differs is None and made is not None and would is not None and made.move is not would.move:
            differs = OtherMove(there.world.tick, made.move, would.move)
    for tick in others:
        other = tick.state
    cause = other.world.cause
    return SoFar(
        varied=dict(varied),
        moves=end - world.episode_start,
        compared=count,
        by_hand=by_hand,
        differs=differs,
        end=end,
        outcome=other.world.outcome,
        tick=other.world.tick,
        hit=None if cause is None else cause.kind,
        rows=_rows_left(timeline.at(end)) - _rows_left(compared),
    )


def driven_otherwise(
    timeline: Timeline, varied: Mapping[str, str | float], stop: int | None = None
) -> Iterator[StepResult]:
    """Each tick of the present episode with other settings, to its end or to a tick.

    Raises `QuestionError`: `no_such_planner`, `too_long_again` where driving it again would take too long,
    `several_drive` with several egos, `not_again` where a new road was begun on the way, `no_answer` of a
    planner that gives none; `ConfigError` for values that cannot be.
    """
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    start = timeline.at(world.episode_start)
    if len(world.avs) > 1:
        raise QuestionError("several_drive")
    planner = varied.get("planner")
    if isinstance(planner, str):
        if planner_named(planner) is None:
            raise QuestionError("no_such_planner", planner=planner)
        start = start.with_ego(planner=None)  # that of the configuration, which is varied
    prepare(start)
    work = faults = 0
    searches = traits_of(str(planner or start.config_of().planner)).plans_to_goal
    try:
        for _, tick in drive_again(timeline, start, last, varied):
            work += work_of_tick(start.world.road) if searches else 0
            decision = tick.decision
            faults = faults + 1 if decision is not None and decision.fault is not None else 0
            late = decision is not None and decision.timed_out
            if decision is not None and (late or faults > MAX_FAULTS):
                raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
            if work > MAX_WORK:
                raise QuestionError("too_long_again")
            yield tick
            if stop is not None and tick.state.world.tick >= stop:
                return
    except NotAgainError as error:
        raise QuestionError("not_again") from error


def _rows_left(state: SimState) -> int:
    return state.world.road.cell(state.world.av)[1]
