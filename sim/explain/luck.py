"""How much of a drive was luck: the same again on the same road, with what is left to chance drawn anew.

The road, what was said and when, and the planner stay as they were; who gives way or brakes, what slips and
what the sensor gets wrong are drawn from other seeds. Where none of that is left to chance, nothing is
driven.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Final

from sim.explain.driven_again import NotAgainError, drive_again
from sim.explain.effort import prepare
from sim.explain.episode_rollout import MAX_WORK, decided, work_of_tick
from sim.explain.question_error import QuestionError
from sim.perceive import sensor_named
from sim.plan import traits_of
from sim.plan.safe_planning import is_foreign
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Outcome

RUNS: Final = 20
"""Seeds that are driven with: those that follow the session's."""
LEAST_RUNS: Final = 5
"""Fewer of them tell nothing."""


@dataclass(frozen=True, slots=True)
class Luck:
    """How the same drive goes with other chances."""

    reactions: bool
    """whether it is left to chance how others react"""
    sensing: bool
    """whether it is left to chance what the sensor shows"""
    slips: bool
    """whether steps to the side may slip"""
    here: Outcome
    """how this drive stands"""
    last: int
    """the tick up to which it is told"""
    to_end: bool
    """whether the others are told to their ends, rather than up to that tick"""
    by_hand: bool
    """whether moves of a person are made again in them"""
    outcomes: tuple[Outcome, ...]
    """how each of them stands; empty where nothing is left to chance"""

    @property
    def by_chance(self) -> bool:
        """Whether anything is left to chance."""
        return self.reactions or self.sensing or self.slips

    @property
    def counts(self) -> Counter[Outcome]:
        """How many stand in each way."""
        return Counter(self.outcomes)

    @property
    def alike(self) -> int:
        """How many stand as this drive does."""
        return self.counts[self.here]


def luck(timeline: Timeline) -> Luck:
    """The present drive beside itself with other chances.

    Raises `QuestionError`: `nothing_yet` where nothing was driven, `not_again` where the road was made anew
    on the way, `too_long_again`.
    """
    state = timeline.state
    world = state.world
    last = timeline.tick if world.ended is None else world.ended
    if last <= world.episode_start:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    start = timeline.at(world.episode_start)
    config = state.config
    slips = bool(config.slips)
    facts = {
        "reactions": config.mover_behaviour.draws(config),
        "sensing": not sensor_named(config.sensor).faithful,
        "slips": slips,
    }
    by_hand = state.ego().mode is Mode.MANUAL or bool(state.ego().queue)
    to_end = world.outcome is not Outcome.RUNNING and not by_hand
    outcomes: tuple[Outcome, ...] = ()
    if any(facts.values()):
        outcomes = _again(timeline, start, last, to_end=to_end)
    return Luck(**facts, here=world.outcome, last=last, to_end=to_end, by_hand=by_hand, outcomes=outcomes)


def _again(timeline: Timeline, start: SimState, last: int, *, to_end: bool) -> tuple[Outcome, ...]:
    """How each of the runs stands; fewer than all where they are much work."""
    name = start.config_of(None).planner
    if is_foreign(name):
        raise QuestionError("too_long_again")
    prepare(start)
    searches = traits_of(name).plans_to_goal
    work, outcomes = 0, []
    for seed in range(start.config.seed + 1, start.config.seed + 1 + RUNS):
        state = start
        try:
            for _, tick in drive_again(timeline, start, last, {"seed": seed}):
                state = tick.state
                work += work_of_tick(start.world.road) if searches else 0
                decision = decided(tick, None)
                if decision is not None and decision.timed_out:
                    raise QuestionError("too_long_again")
                if work > MAX_WORK or (not to_end and state.world.tick >= last):
                    break
        except NotAgainError as error:
            raise QuestionError("not_again") from error
        if work > MAX_WORK and state.world.outcome is Outcome.RUNNING:
            break
        outcomes.append(state.world.outcome)
    if len(outcomes) < LEAST_RUNS:
        raise QuestionError("too_long_again")
    return tuple(outcomes)
