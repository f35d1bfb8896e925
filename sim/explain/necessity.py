"""Whether a move was needed: what straight on would have met in that tick, and how it would have ended.

It is judged by what was there, whatever was seen of it. The move is compared with straight on, and straight
on with waiting. A wait is judged as a whole: straight on may have been shut in a later tick of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from itertools import takewhile
from typing import Final

from sim.explain.alternatives import Alternatives, after_move, stakes
from sim.explain.query import LOOK_BACK_TICKS, SAID_OF, decision_meant, latest_decision
from sim.explain.question_error import QuestionError
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import MOVES, Move, Outcome

MOST_STOOD: Final = 60
"""Ticks of one wait that are looked at in each direction."""


class Need(StrEnum):
    """How far a move was needed."""

    SHUT = "shut"
    """the other move would have met something in that tick"""
    BOTH = "both"
    """both moves met something in that tick"""
    OFF_ROAD = "off_road"
    """the other move leads off the road"""
    CRASH = "crash"
    """the other move was free, and a crash would have come of it, as none does of the one made"""
    STUCK = "stuck"
    """the other move was free, and would not have led to the goal, as the one made does"""
    CHANCE = "chance"
    """the other move was free; how it ends is left to chance after one of them"""
    LATER = "later"
    """the other move was free, and its best way on takes longer"""
    NOT = "not"
    """the other move was free, and ends no worse"""


@dataclass(frozen=True, slots=True)
class Necessity:
    """A move, and what the other one would have been."""

    state: SimState
    decision: Decision
    foil: Move
    """straight on; waiting, where straight on is the move that is judged"""
    need: Need
    hit: tuple[str, ...]
    """what the other move would have met in that tick"""
    free: tuple[Move, ...]
    """moves besides the two that would have met nothing in that tick"""
    stakes: Alternatives | None
    """how it ends after each of the two; None where the other could not be made"""
    stood: int
    """ticks of the wait, where it is one that is judged; else 1"""
    shut: int
    """in how many of them the other move would have met something"""

    @property
    def needed(self) -> bool | None:
        """Whether it was needed; None where that is left to chance."""
        if self.need is Need.CHANCE:
            return None
        return self.need in (Need.SHUT, Need.OFF_ROAD, Need.CRASH, Need.STUCK)


def necessity(timeline: Timeline, tick: int | None = None, move: Move | None = None) -> Necessity:
    """Whether a move of the first ego was needed: that of a tick, or the latest such one.

    Without a move it is the latest that was not straight on. Raises `QuestionError`: as `decision_meant`
    does, `never_made`, `not_that_move`, and `no_detour` where every move was straight on.
    """
    state, decision = _meant(timeline, tick, move)
    foil = Move.STAY if decision.move is Move.FORWARD else Move.FORWARD
    tried = [state]
    if decision.move is Move.STAY:
        tried = _wait(timeline, state)
    met = [(each, found) for each in tried if (found := _met(each, foil)) is not None]
    if met:
        state, hit = next(
            ((each, found) for each, found in met if each.world.tick == state.world.tick), met[0]
        )
        decision = timeline.decided(state) or decision
    else:
        state, hit = tried[0], ()
        decision = timeline.decided(state) or decision
    free = tuple(
        other
        for other in MOVES
        if other not in (foil, decision.move)
        and decision.option(other).cell is not None
        and _met(state, other) is None
    )
    stake = None if met else stakes(state, decision, foil)
    need = (Need.BOTH if _met(state, decision.move) is not None else Need.SHUT) if met else _need(stake)
    return Necessity(state, decision, foil, need, hit, free, stake, len(tried), len(met))


def _meant(timeline: Timeline, tick: int | None, move: Move | None) -> tuple[SimState, Decision]:
    """The decision that is judged, with the state before it."""
    if tick is not None:
        state, decision = decision_meant(timeline, tick, None)
        if move is not None and decision.move not in SAID_OF.get(move, (move,)):
            raise QuestionError("not_that_move", asked=move, made=decision.move, tick=decision.tick)
        return state, decision
    moves = (
        tuple(each for each in MOVES if each is not Move.FORWARD)
        if move is None
        else SAID_OF.get(move, (move,))
    )
    state, found = latest_decision(timeline, moves)
    if found is None:
        ticks = min(timeline.tick, LOOK_BACK_TICKS)
        raise (
            QuestionError("no_detour", ticks=ticks)
            if move is None
            else QuestionError("never_made", move=move, ticks=ticks)
        )
    return state, found


def _wait(timeline: Timeline, state: SimState) -> list[SimState]:
    """The states of a wait that a tick belongs to, in their order."""
    tick, start = state.world.tick, state.world.episode_start

    def waits(each: SimState) -> bool:
        decision = timeline.decided(each)
        return decision is not None and decision.move is Move.STAY

    before = list(timeline.between(max(start, tick - MOST_STOOD), tick))
    after = list(timeline.between(tick, min(timeline.tick, tick + MOST_STOOD)))
    return [*reversed(list(takewhile(waits, reversed(before)))), *takewhile(waits, after)]


def _met(state: SimState, move: Move) -> tuple[str, ...] | None:
    """What a move meets in this tick; None where it meets nothing."""
    world = after_move(state, move).world
    if world.outcome is not Outcome.CRASH or world.cause is None:
        return None
    return tuple(name for name in world.cause.ids if name != state.ego().id)


def _need(found: Alternatives | None) -> Need:
    """How far a move was needed whose other one meets nothing in that tick."""
    if found is None:
        return Need.OFF_ROAD
    if found.by_chance:
        return Need.CHANCE
    would, real = found.would, found.real
    if would is not None and real is not None and would.outcome is not real.outcome:
        if would.outcome is Outcome.CRASH:
            return Need.CRASH
        if real.outcome is Outcome.SUCCESS:
            return Need.STUCK
        return Need.NOT
    if found.dead_end:
        return Need.STUCK
    return Need.LATER if (found.ticks_lost or 0) > 0 else Need.NOT
