"""Moves of a person that the planner would not have made, each decided anew from its own moment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.decide import decide
from sim.explain.effort import prepare
from sim.explain.episode_rollout import MAX_WORK
from sim.explain.foresight import driving
from sim.explain.question_error import QuestionError
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.types import Mode, Move

MOST_TICKS: Final = 200
"""Ticks of an episode whose moves are looked at; of a longer one the last."""


@dataclass(frozen=True, slots=True)
class Differing:
    """One move of a person, and the planner's in its place."""

    tick: int
    made: Move
    would: Move


@dataclass(frozen=True, slots=True)
class ManualDrive:
    """The moves of a person in the present episode."""

    first: int
    last: int
    by_hand: int
    """moves that a person asked for"""
    found: tuple[Differing, ...]
    """those that the planner would not have made"""
    unknown: int
    """those of which it is not known, since the planner gave no answer"""


def differing(timeline: Timeline) -> ManualDrive:
    """The moves of a person that the planner would not have made, for the first ego.

    Raises `QuestionError`: `too_long_again` where asking the planner for all of them would take too long.
    """
    state = timeline.state
    prepare(state)
    world = state.world
    last = timeline.tick if world.ended is None else world.ended
    first = max(world.episode_start, last - MOST_TICKS)
    road = world.road
    found, by_hand, unknown = [], 0, 0
    for before in timeline.between(first, last) if first < last else ():
        if not before.ego().queue and before.ego().mode is not Mode.MANUAL:
            continue
        made = timeline.decided(before)
        if made is None or made.asked is None:
            continue
        by_hand += 1
        quick = traits_of(before.config_of(None).planner).quick
        if not quick and by_hand * road.columns * road.rows * road.rows > MAX_WORK:
            raise QuestionError("too_long_again")
        would = decide(driving(before))
        if would is None or would.fault is not None:
            unknown += 1
        elif would.move is not made.move:
            found.append(Differing(before.world.tick, made.move, would.move))
    return ManualDrive(first, last, by_hand, tuple(found), unknown)
