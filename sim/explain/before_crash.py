"""The last ticks before the latest crash: what was hit, and the ego, tick by tick, read off the timeline."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from sim.explain.past import latest_crash
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, is_ego
from sim.world import Thing

TICKS: Final = 4
"""Ticks before a crash that are told."""


@dataclass(frozen=True, slots=True)
class BeforeCrash:
    """What was hit, and the ego, in the last ticks before a crash."""

    before: SimState
    """the state before the crash"""
    tick: int
    """the tick that the crash shows at"""
    thing: Thing | None
    """what was hit, as it was before the crash; None for another ego"""
    theirs: tuple[Move, ...]
    """its steps; empty for what never moves"""
    own: tuple[Move, ...]
    """the ego's moves in the same ticks"""


def before_crash(timeline: Timeline) -> BeforeCrash:
    """The last ticks before the latest crash of the first ego. Raises `QuestionError`: `no_crash_at_all`."""
    tick = latest_crash(timeline)
    cause = None if tick is None else timeline.at(tick).world.cause
    if tick is None or cause is None:
        raise QuestionError("no_crash_at_all")
    start = max(timeline.at(tick).world.episode_start, tick - TICKS)
    states = list(timeline.between(start, tick + 1))
    before = states[-2]
    name = next((each for each in cause.ids if not is_ego(each)), None)
    thing = None if name is None else before.world.find(name)
    own = tuple(decision.move for state in states[:-1] if (decision := timeline.decided(state)) is not None)
    theirs: list[Move] = []
    if thing is not None and thing.kind.moves:
        for one, other in pairwise(states):
            was, now = one.world.find(thing.id), other.world.find(thing.id)
            if was is not None and now is not None:
                across = now.cell[0] - was.cell[0]
                theirs.append(Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT)
    return BeforeCrash(before, tick, thing, tuple(theirs), own)
