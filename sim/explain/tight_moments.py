"""The ticks of the present episode in which one move of the first ego, or none, would have met nothing."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sim.explain.pattern import move_between
from sim.explain.riskiest import MOST_TICKS, Risk, risk_of
from sim.session.timeline import Timeline


@dataclass(frozen=True, slots=True)
class TightMoments:
    """The moments with hardly a move left."""

    first: int
    """the tick from which on was looked"""
    judged: int
    """ticks that were looked at"""
    one: tuple[Risk, ...]
    """those with one move that would have met nothing"""
    none: tuple[Risk, ...]
    """those without any"""


def tight_moments(timeline: Timeline) -> TightMoments:
    """Each move of each tick of the episode is made and judged, as for the riskiest moment."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    first = max(world.episode_start, last - MOST_TICKS)
    risks = [
        risk_of(before, after, made)
        for before, after in pairwise(timeline.between(first, last + 1))
        if (made := move_between(before, after)) is not None
    ]
    one = tuple(each for each in risks if len(each.free) == 1)
    none = tuple(each for each in risks if not each.free)
    return TightMoments(first, len(risks), one, none)
