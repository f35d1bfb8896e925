"""What happened in a stretch of past ticks, read off the timeline: nothing is decided again for it."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, fields
from typing import Final

from sim.actions import Drive, SetMode
from sim.explain.closest_call import ClosestCall, closest_call
from sim.metrics import Metrics
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Outcome

MOST_TICKS: Final = 5_120
"""Ticks of a stretch that is read: as many as the longest episode has."""


@dataclass(frozen=True, slots=True)
class Past:
    """A stretch of ticks in facts, both its ends included."""

    first: SimState
    last: SimState
    counted: Metrics
    """what was counted between the two states"""
    ends: tuple[tuple[int, Outcome], ...]
    """the ticks at which episodes ended, and how"""
    roads: int
    """episodes begun after the first tick"""
    changes: int
    """changes of the road or of settings that were said in it; driving by hand is none"""
    closest: ClosestCall | None

    @property
    def ticks(self) -> int:
        """Ticks from the first state to the last."""
        return self.last.world.tick - self.first.world.tick


def past(timeline: Timeline, first: int, last: int) -> Past:
    """What happened from tick `first` to tick `last`. Raises `IndexError` for ticks that never were."""
    states = list(timeline.between(first, last + 1))
    worlds = [state.world for state in states]
    entries = timeline.entries
    at = bisect_left(entries, first, key=lambda entry: entry.tick)
    until = bisect_left(entries, last + 1, key=lambda entry: entry.tick)
    return Past(
        first=states[0],
        last=states[-1],
        counted=_difference(states[0].metrics, states[-1].metrics),
        ends=tuple((world.tick, world.outcome) for world in worlds[1:] if world.ended == world.tick),
        roads=sum(world.episode_start == world.tick for world in worlds[1:]),
        changes=len(
            {
                entries[index].sequence
                for index in range(at, until)
                if not isinstance(entries[index].action, (SetMode, Drive))
            }
        ),
        closest=closest_call(states),
    )


def latest_crash(timeline: Timeline) -> int | None:
    """The tick at which the latest crash shows; None where there was none.

    Crashes are only ever counted up along a timeline, so the tick is searched by halves.
    """
    crashes = _crashes(timeline.state)
    if not crashes:
        return None
    return bisect_left(range(timeline.tick), crashes, key=lambda tick: _crashes(timeline.at(tick)))


def _crashes(state: SimState) -> int:
    return sum(ego.metrics.crashes for ego in state.egos.values())


def _difference(before: Metrics, after: Metrics) -> Metrics:
    """What was counted between two moments of one timeline."""
    names = [field.name for field in fields(Metrics) if field.name != "last_episode_ticks"]
    return Metrics(**{name: getattr(after, name) - getattr(before, name) for name in names})
