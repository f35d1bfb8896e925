"""Where the first ego was at each tick of the present drive: its lanes and rows, and what follows from them.

Read off the timeline; nothing is driven again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Cell, Outcome


@dataclass(frozen=True, slots=True)
class DriveTrack:
    """The cells of a drive, one a tick."""

    first: int
    """the tick of the first cell"""
    cells: tuple[Cell, ...]
    """lane (from 0 at the left) and row (0 is the goal's) at each tick"""
    distance_m: float
    """metres driven"""
    outcome: Outcome

    @property
    def ticks(self) -> int:
        """Ticks that were driven."""
        return len(self.cells) - 1

    @property
    def last(self) -> int:
        """The latest tick of the drive."""
        return self.first + self.ticks

    @property
    def across(self) -> tuple[tuple[int, int], ...]:
        """Each step to another lane: the tick in which it was made, and lanes to the right."""
        steps = enumerate(pairwise(self.cells), self.first)
        return tuple((tick, now[0] - was[0]) for tick, (was, now) in steps if now[0] != was[0])

    @property
    def stops(self) -> tuple[tuple[int, int], ...]:
        """Each stop: the tick in which it began, and how many ticks it lasted."""
        found: list[tuple[int, int]] = []
        for tick, (was, now) in enumerate(pairwise(self.cells), self.first):
            if was != now:
                continue
            if found and sum(found[-1]) == tick:
                found[-1] = found[-1][0], found[-1][1] + 1
            else:
                found.append((tick, 1))
        return tuple(found)

    @property
    def reversals(self) -> tuple[int, ...]:
        """The ticks of the steps across that led to the other side than the step across before them."""
        return tuple(tick for (_, was), (tick, now) in pairwise(self.across) if was * now < 0)

    @property
    def unadvanced(self) -> tuple[int, ...]:
        """The ticks in which it came no row nearer to the goal."""
        steps = enumerate(pairwise(self.cells), self.first)
        return tuple(tick for tick, (was, now) in steps if now[1] >= was[1])

    @property
    def nearest(self) -> int:
        """The first tick at which it was in the row nearest to the goal."""
        rows = [row for _, row in self.cells]
        return self.first + rows.index(min(rows))

    @property
    def here_since(self) -> int:
        """Since which tick it has been in the cell that it is in, without a break."""
        return self._since(lambda cell: cell == self.cells[-1])

    @property
    def lane_since(self) -> int:
        """Since which tick it has been in the lane that it is in, without a break."""
        return self._since(lambda cell: cell[0] == self.cells[-1][0])

    def per_100_m(self, count: int) -> float | None:
        """So many on 100 m of the way driven; None where none was driven."""
        return None if not self.distance_m else 100 * count / self.distance_m

    def _since(self, holds: Callable[[Cell], bool]) -> int:
        tick = self.last
        for cell in reversed(self.cells):
            if not holds(cell):
                break
            tick -= 1
        return tick + 1


def drive_track(timeline: Timeline) -> DriveTrack:
    """The present drive up to now, or to its end. Raises `QuestionError`: `nothing_yet`, `too_long`."""
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if first >= last:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    states = list(timeline.between(first, last + 1))
    cells = tuple(state.world.road.cell(state.world.av) for state in states)
    driven = states[-1].metrics.distance_m - states[0].metrics.distance_m
    return DriveTrack(first, cells, driven, world.outcome)
