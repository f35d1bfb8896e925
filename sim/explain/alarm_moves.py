"""Which moves of a drive were made because of what was seen wrongly: each is decided again without that."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import decide_on, sense
from sim.explain.misperception import misperception
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.perceive import perceive_truth, sensor_named
from sim.session.timeline import Timeline
from sim.types import Move


@dataclass(frozen=True, slots=True)
class AlarmMoves:
    """The decisions of a drive, counted by what their sensor got wrong."""

    faithful: bool
    decisions: int
    """of the planner, not of a person"""
    alarmed: int
    """decisions at which something was seen that never existed"""
    changed: tuple[tuple[int, Move, Move], ...]
    """of those: the tick, the move, and the one that is decided without what never existed"""
    wrong: int
    """decisions at which anything was seen where it was not, or not seen"""
    otherwise: int
    """of those: decided otherwise where just what was there is seen"""


def alarm_moves(timeline: Timeline) -> AlarmMoves:
    """The moves of the present drive that hang on what was seen wrongly. Raises `QuestionError`.

    `too_long`; `nothing_yet` before the first move; `no_answer` where a planner fails.
    """
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    if last == first:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    faithful = sensor_named(timeline.state.config.sensor).faithful
    decisions = alarmed = wrong = otherwise = 0
    changed = []
    for state in timeline.between(first, last):
        made = timeline.decided(state)
        if made is None or made.asked is not None:
            continue
        decisions += 1
        seen = misperception(state)
        if not seen.phantoms and not seen.missed:
            continue
        wrong += 1
        truth = decide_on(state, perceive_truth(state.world, state.config_of(None), 0))
        if truth.fault is not None:
            raise QuestionError("no_answer", planner=truth.planner, fault=truth.fault)
        otherwise += truth.move is not made.move
        there = {each.id for each in state.world.things()}
        alarms = [each.id for each in seen.phantoms if each.id not in there]
        if alarms:
            alarmed += 1
            without = decide_on(state, sense(state)[0].without(alarms))
            if without.fault is not None:
                raise QuestionError("no_answer", planner=without.planner, fault=without.fault)
            if without.move is not made.move:
                changed.append((state.world.tick, made.move, without.move))
    return AlarmMoves(faithful, decisions, alarmed, tuple(changed), wrong, otherwise)
