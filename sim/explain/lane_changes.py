"""How often the first ego has changed lanes in the present episode, and to which side."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class LaneChange:
    """A move that led into another lane."""

    tick: int
    """the tick at which it was decided"""
    left: bool
    diagonal: bool


@dataclass(frozen=True, slots=True)
class LaneChanges:
    """The lane changes of the present episode."""

    driven: int
    """ticks of the episode up to now"""
    found: tuple[LaneChange, ...]
    """in their order"""

    @property
    def left(self) -> int:
        """Lane changes to the left."""
        return sum(each.left for each in self.found)

    @property
    def right(self) -> int:
        """Lane changes to the right."""
        return len(self.found) - self.left

    @property
    def diagonal(self) -> int:
        """Lane changes that were diagonal moves."""
        return sum(each.diagonal for each in self.found)


def lane_changes(timeline: Timeline) -> LaneChanges:
    """The lane changes of the first ego: a step that was lost on snow changes no lane."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    found = []
    for before, after in pairwise(timeline.between(world.episode_start, last + 1)):
        one, other = before.world, after.world
        if one.outcome is not Outcome.RUNNING or one.road != other.road:
            continue
        (column, row), (there, ahead) = one.road.cell(one.av), other.road.cell(other.av)
        if column != there:
            found.append(LaneChange(one.tick, left=there < column, diagonal=ahead != row))
    return LaneChanges(last - world.episode_start, tuple(found))
