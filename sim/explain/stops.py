"""The stops of the present episode: when the first ego stood, for how long, and for whom, by re-running each.

A stop is made of ticks in a row in which a wait was decided. It was for what the first of them hung on:
without that, another move would have been made.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sim.explain.pattern import instance_of, most_retaken, move_between
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Move, kind_of


@dataclass(frozen=True, slots=True)
class Stop:
    """A stop, and what it was for."""

    before: SimState
    """the state in which it was decided"""
    ticks: int
    ids: tuple[str, ...] | None
    """what it was for; None where that was not looked for"""

    @property
    def tick(self) -> int:
        """The tick at which it was decided."""
        return self.before.world.tick

    @property
    def kinds(self) -> tuple[Kind, ...]:
        """The kinds of things that it was for."""
        return tuple(dict.fromkeys(kind_of(id) for id in self.ids or ()))


@dataclass(frozen=True, slots=True)
class Stops:
    """The stops of the present episode."""

    driven: int
    """ticks of the episode up to now"""
    found: tuple[Stop, ...]
    """in their order"""

    @property
    def ticks(self) -> int:
        """Ticks stood in all."""
        return sum(stop.ticks for stop in self.found)

    @property
    def unknown(self) -> int:
        """Stops of which it was not looked for what they were for."""
        return sum(stop.ids is None for stop in self.found)

    def of(self, kind: Kind) -> tuple[Stop, ...]:
        """Those that were for things of a kind."""
        return tuple(stop for stop in self.found if kind in stop.kinds)


def stops(timeline: Timeline) -> Stops:
    """The stops of the present episode, each with what it was for; of very many that of the latest."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    groups: list[list[SimState]] = []
    stood = False
    for before, after in pairwise(timeline.between(world.episode_start, last + 1)):
        stays = move_between(before, after) is Move.STAY and _was_decided(timeline, before)
        if stays and stood:
            groups[-1].append(before)
        elif stays:
            groups.append([before])
        stood = stays
    looked = max(0, len(groups) - most_retaken(timeline))
    found = tuple(
        Stop(group[0], len(group), None if number < looked else instance_of(timeline, group[0]).ids)
        for number, group in enumerate(groups)
    )
    return Stops(last - world.episode_start, found)


def _was_decided(timeline: Timeline, state: SimState) -> bool:
    """Whether a wait was decided, rather than a step lost on snow."""
    decision = timeline.decided(state)
    return decision is not None and decision.move is Move.STAY
