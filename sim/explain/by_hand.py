"""Which moves of the present episode a person asked for, since when, and which of them were held back."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import decide
from sim.explain.effort import prepare
from sim.explain.foresight import driving
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Move, Outcome


@dataclass(frozen=True, slots=True)
class HeldBack:
    """A move that was asked for and not made."""

    tick: int
    asked: Move


@dataclass(frozen=True, slots=True)
class ByHand:
    """A person's part in the present episode."""

    since: int
    """the first tick of the latest stretch in which a person drove"""
    until: int | None
    """the last tick of that stretch; None where the person drives still"""
    now: int
    moves: int
    """moves that a person asked for in the whole episode; pressing nothing while driving asks to stay"""
    held_back: tuple[HeldBack, ...]
    would: Move | None
    """what the planner was about to do at `since`; None where it gave no answer"""


def by_hand(timeline: Timeline) -> ByHand:
    """Of the first ego. Raises `QuestionError`: `not_by_hand` where no person has driven in this episode."""
    state = timeline.state
    world = state.world
    last = timeline.tick if world.ended is None else world.ended
    drives = world.outcome is Outcome.RUNNING and _by_person(state)
    ticks: list[int] = []
    held = []
    first = world.episode_start
    for before in timeline.between(first, last) if first < last and timeline.entries else ():
        if not _by_person(before):
            continue
        ticks.append(before.world.tick)
        made = timeline.decided(before)
        if made is not None and made.asked is not None and made.held_back:
            held.append(HeldBack(before.world.tick, made.asked))
    if not ticks and not drives:
        raise QuestionError("not_by_hand")
    end = last if drives else ticks[-1]
    since, driven = end, set(ticks)
    while since - 1 in driven:
        since -= 1
    prepare(state)
    decision = decide(driving(timeline.at(since)))
    would = None if decision is None or decision.fault is not None else decision.move
    return ByHand(since, None if drives else end, timeline.tick, len(ticks), tuple(held), would)


def _by_person(state: SimState) -> bool:
    ego = state.ego()
    return bool(ego.queue) or ego.mode is Mode.MANUAL
