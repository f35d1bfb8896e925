"""How many rows the ego came ahead in a stretch of a drive."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sim.explain.occurrences import Query, stretch_of
from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class Advance:
    """What was driven in a stretch."""

    first: int
    last: int
    """the first and the last tick of the stretch"""
    ticks: int
    """those of them in which it drove"""
    rows: int
    """rows that it came nearer to the goal in them; over several drives, in all of them"""


def advance(timeline: Timeline, query: Query) -> Advance:
    """The rows of the stretch that a query names. Raises `QuestionError`: `no_such_tick`, `too_long`.

    Between two ticks that is from where it was at the one to where it was at the other.
    """
    first, stop = stretch_of(timeline, query)
    last = stop - 1
    if query.last is not None and last > first:
        stop = last
    ticks = rows = 0
    states = timeline.between(first, min(stop, timeline.tick) + 1)
    for before, after in pairwise(states):
        world, then = before.world, after.world
        if world.outcome is not Outcome.RUNNING or then.episode != world.episode:
            continue
        ticks += 1
        rows += world.road.cell(world.av)[1] - then.road.cell(then.av)[1]
    return Advance(first, last, ticks, rows)
