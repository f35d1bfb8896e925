"""A move that is made again and again: how often, and what stood behind it each time, by re-running each."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from sim.explain.facts import QuestionError
from sim.explain.intervention import Intervention
from sim.explain.query import SAID_OF
from sim.explain.telling import telling_option
from sim.explain.why_causes import by_salience
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Move, Outcome, kind_of

MOST_TICKS: Final = 400
"""Ticks of a stretch that are read; of a longer one the last."""
MOST_SINGLES: Final = 6
"""Things that are taken away one by one, where what stands in the way does not tell."""
MOST_DECISIONS: Final = 60
"""Decisions that are taken again; fewer with a planner whose decisions take long."""


@dataclass(frozen=True, slots=True)
class Instance:
    """One of the decisions, and what it hung on."""

    before: SimState
    ids: tuple[str, ...]
    """what it hung on; without it another move is made"""
    rather: Move | None
    """the move that is made without it"""
    by_hand: bool = False
    """whether a person asked for the move, so that it hung on nothing"""

    @property
    def tick(self) -> int:
        """The tick at which it was decided."""
        return self.before.world.tick

    @property
    def kind(self) -> Kind | None:
        """The kind of the first thing that was in the way."""
        return kind_of(self.ids[0]) if self.ids else None


@dataclass(frozen=True, slots=True)
class Pattern:
    """How often a move was made in a stretch, and what stood behind it."""

    move: Move
    first: int
    last: int
    """the last tick of the stretch"""
    seconds: float
    """how long the stretch is"""
    made: int
    """how many of its moves were this one"""
    decided: int
    """how many moves there were in all"""
    instances: tuple[Instance, ...]
    """those that were taken again, the latest first"""

    def kinds(self) -> list[tuple[Kind, int]]:
        """How often each kind of thing was in the way, the most frequent first."""
        counts = Counter(each.kind for each in self.instances if each.kind is not None)
        return counts.most_common()


def pattern(
    timeline: Timeline, move: Move | None = None, first: int | None = None, last: int | None = None
) -> Pattern:
    """How often the first ego made a move in a stretch of ticks, this episode by default, and why.

    Without a move it is the most frequent one that is not straight on. Raises `QuestionError`:
    `no_such_tick`, `nothing_yet`, `never_made`, `always_straight`.
    """
    now, world = timeline.tick, timeline.state.world
    first = world.episode_start if first is None else first
    last = (now if world.ended is None else min(now, world.ended)) if last is None else last
    if max(first, last) > now:
        raise QuestionError("no_such_tick", tick=max(first, last), now=now)
    if first >= last:
        raise QuestionError("nothing_yet", tick=now)
    first = max(first, last - MOST_TICKS)
    states = list(timeline.between(first, last + 1))
    moves = [
        (state, made) for state, after in pairwise(states) if (made := move_between(state, after)) is not None
    ]
    if move is None:
        move = _most_frequent([made for _, made in moves])
    if move is None:
        raise QuestionError("always_straight", ticks=len(moves))
    alike = [state for state, made in moves if made in SAID_OF.get(move, (move,))]
    if not alike:
        raise QuestionError("never_made", move=move, ticks=last - first)
    instances = tuple(instance_of(timeline, state) for state in reversed(alike[-most_retaken(timeline) :]))
    seconds = (last - first) * timeline.state.config.step_seconds
    return Pattern(move, first, last, seconds, len(alike), len(moves), instances)


def move_between(before: SimState, after: SimState) -> Move | None:
    """The move of the first ego from one state to the next; None where it was no move of a drive."""
    one, other = before.world, after.world
    same = (one.episode, one.episode_start, one.road) == (other.episode, other.episode_start, other.road)
    if one.outcome is not Outcome.RUNNING or not same:
        return None
    dynamics = before.config.ego_dynamics(one.road)
    return next((move for move in Move if dynamics.target(one.av, move) == other.av), None)


def instance_of(timeline: Timeline, state: SimState) -> Instance:
    """What the decision in a state hung on; nothing of a move that a person asked for."""
    decision = timeline.decided(state)
    if decision is None or decision.asked is not None:
        return Instance(state, (), None, by_hand=decision is not None)
    rerun = Intervention(state, decision, timeline.announced(state))
    option = telling_option(state, decision)
    tried = [] if option is None else [tuple(option.causes)]
    tried += [(name,) for name in by_salience(rerun.percept, decision)[:MOST_SINGLES]]
    for ids in tried:
        if (rather := rerun.without(ids)) is not decision.move:
            return Instance(state, ids, rather)
    return Instance(state, (), None)


def _most_frequent(moves: list[Move]) -> Move | None:
    """The most frequent move that is not straight on, both moves to a side as one."""
    sides = {other: side for side, both in SAID_OF.items() for other in both}
    counts = Counter(sides.get(move, move) for move in moves if move is not Move.FORWARD)
    return counts.most_common(1)[0][0] if counts else None


def most_retaken(timeline: Timeline) -> int:
    """How many decisions are taken again."""
    traits = traits_of(timeline.state.config.planner)
    return MOST_DECISIONS if traits.quick else max(1, MOST_DECISIONS // 6)
