"""How long the first ego has waited in the present episode: ticks in which it kept its cell."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class Waits:
    """Ticks of the present episode in which the ego kept its cell."""

    driven: int
    """ticks of the episode up to now"""
    total: int
    now: int
    """the latest of them without a break; 0 where the last move led somewhere"""
    since: int | None
    """the tick of the first of those; None where it does not wait"""


def waits(timeline: Timeline) -> Waits:
    """How long the ego has waited."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    total = now = 0
    states = timeline.between(world.episode_start, last + 1)
    for before, after in pairwise(states):
        if before.world.outcome is not Outcome.RUNNING:
            continue
        stayed = before.world.av == after.world.av
        total, now = total + stayed, now + 1 if stayed else 0
    return Waits(last - world.episode_start, total, now, last - now if now else None)
