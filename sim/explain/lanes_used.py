"""For how long the first ego has been in each lane in the present episode."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class LanesUsed:
    """Ticks in each lane."""

    driven: int
    """ticks of the episode up to now"""
    ticks: tuple[tuple[int, int], ...]
    """lanes, from 1 at the left, each with its ticks; the longest first"""


def lanes_used(timeline: Timeline) -> LanesUsed:
    """A tick counts for the lane in which it began."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    counts: Counter[int] = Counter()
    for state in timeline.between(world.episode_start, last):
        if state.world.outcome is Outcome.RUNNING:
            counts[state.world.road.cell(state.world.av)[0] + 1] += 1
    return LanesUsed(
        last - world.episode_start, tuple(sorted(counts.items(), key=lambda each: (-each[1], each[0])))
    )
