"""How old what is believed of each thing is: in how many ticks before now a device last reported it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

from sim.decide import sense
from sim.explain.scene import Detection, describe_percept
from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import PLACEABLE

MOST_BACK: Final = 100
"""Ticks that are looked back."""


@dataclass(frozen=True, slots=True)
class LastDetected:
    """A thing that is believed, and when it was last reported."""

    thing: Detection
    tick: int | None
    """the latest tick in which a device reported it; None where none did in the ticks looked at"""


@dataclass(frozen=True, slots=True)
class BeliefAges:
    """All things that are believed now, the longest without a report first."""

    state: SimState
    faithful: bool
    """whether the sensor shows what is there, in each tick anew"""
    known: bool
    """whether the sensor's reports can be looked at"""
    first: int
    """the earliest tick that was looked at"""
    found: tuple[LastDetected, ...]

    def find(self, id: str) -> LastDetected | None:
        """The thing with an id."""
        return next((each for each in self.found if each.thing.id == id), None)

    def age(self, each: LastDetected) -> int | None:
        """Ticks since it was last reported; None where that is longer ago than was looked."""
        return None if each.tick is None else self.state.world.tick - each.tick


def last_detected(timeline: Timeline) -> BeliefAges:
    """When each thing that the first ego believes in was last reported."""
    state = timeline.state
    now = state.world.tick
    faithful = sensor_named(state.config.sensor).faithful
    seen = [each for each in describe_percept(sense(state)[0], state.config).seen if each.kind in PLACEABLE]
    suite = SUITES.get(state.config.sensor)
    if faithful or suite is None:
        found = tuple(LastDetected(each, now if faithful else None) for each in seen)
        return BeliefAges(state, faithful, faithful, now, found)
    left, ticks, first = {each.id: each for each in seen}, {}, now
    for before in _looked_at(timeline):
        first = before.world.tick
        for id in _reported(before, left.values()):
            ticks[id] = first
            del left[id]
        if not left:
            break
    found = tuple(LastDetected(each, ticks.get(each.id)) for each in seen)
    oldest = sorted(found, key=lambda each: (each.tick is not None, each.tick or 0, -abs(each.thing.rows)))
    return BeliefAges(state, False, True, first, tuple(oldest))


def _looked_at(timeline: Timeline) -> Iterator[SimState]:
    """The states whose looks the present belief is made of, the latest first."""
    state = timeline.state
    now, start = state.world.tick, state.world.episode_start
    if not (state.config.sensor_latency and now > start):  # a late look is not yet in the belief
        yield state
    for tick in range(now - 1, max(start, now - MOST_BACK) - 1, -1):
        yield timeline.at(tick)


def _reported(state: SimState, things: Iterable[Detection]) -> list[str]:
    """The ids of those of the things that some device reports in its look of a state."""
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.grid_sensor import looks

    suite = SUITES.get(state.config.sensor, ())
    ids, cells = set(), set()
    for each in looks(state.world, state.config, 0, suite):
        for report in each.reports:
            ids.add((report.kind, report.id))
            cells.add((report.kind, report.cell))
    index = state.world.road.index
    return [
        each.id for each in things if (each.kind, each.id) in ids or (each.kind, index(each.cell)) in cells
    ]
