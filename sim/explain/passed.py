"""What the first ego has left behind in the present episode: things that were ahead of it before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Kind


@dataclass(frozen=True, slots=True)
class Passed:
    """The things that were passed, by kind."""

    driven: int
    """ticks of the episode up to now"""
    ids: Mapping[Kind, tuple[str, ...]]


def passed(timeline: Timeline) -> Passed:
    """What was ahead of the ego at a tick, and behind it at a later one of the same episode."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    ahead: set[str] = set()
    behind: dict[str, Kind] = {}
    level = None
    for state in timeline.between(world.episode_start, last + 1):
        now = state.world
        row = now.road.cell(now.av)[1]
        if row == level:
            continue
        level = row
        for thing in now.things():
            if thing.cell[1] < row:
                ahead.add(thing.id)
            elif thing.cell[1] > row and thing.id in ahead:
                behind[thing.id] = thing.kind
    ids = {kind: tuple(id for id, each in behind.items() if each is kind) for kind in PLACEABLE}
    return Passed(last - world.episode_start, ids)
