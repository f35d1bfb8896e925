"""Since when each thing of a drive was detected, how far off it was then, and whether it was lost again.

Every tick of the present episode is looked at as the sensor showed it then. A thing is detected where it is
shown in the very cell it is in: what is only believed to be where it once was is not.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from sim.decide import sense
from sim.explain.crash import is_detected
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Cell, Kind


@dataclass(frozen=True, slots=True)
class Sighting:
    """One thing of a drive, and when it was detected."""

    id: str
    kind: Kind
    first: int | None
    """the first tick at which it was detected; None if it never was"""
    rows: int
    """rows that it was ahead then, behind below 0; 0 if it was never detected"""
    cell: Cell
    """where it was then; else where it was last"""
    lost: tuple[tuple[int, int], ...]
    """stretches of ticks, both ends included, in which it was ahead and not detected any more"""
    there_at_first: bool
    """whether it was on the road when the drive began"""
    passed: int | None
    """the tick since which it is behind, having been ahead; None where it is not"""


@dataclass(frozen=True, slots=True)
class Sightings:
    """All things of the present drive, in the order in which they were detected."""

    first: int
    last: int
    """the ticks that were looked at, both included"""
    things: tuple[Sighting, ...]

    def of(self, kind: Kind | None) -> tuple[Sighting, ...]:
        """Those of a kind, or all."""
        return tuple(each for each in self.things if kind in (None, each.kind))

    def find(self, id: str) -> Sighting | None:
        """The thing with an id."""
        return next((each for each in self.things if each.id == id), None)


@dataclass(frozen=True, slots=True)
class Noticed:
    """What is detected at a tick and was not at the one before, and the other way round."""

    state: SimState
    new: tuple[str, ...]
    gone: tuple[str, ...]


@dataclass(slots=True)
class _Seen:
    """What is found out of a thing, tick by tick."""

    kind: Kind
    cell: Cell
    there_at_first: bool
    first: int | None = None
    rows: int = 0
    lost: list[tuple[int, int]] = field(default_factory=list)
    ahead: bool = False
    passed: int | None = None

    def look(self, tick: int, cell: Cell, row: int, detected: bool) -> None:
        """One tick in which it was on the road; `row`: the ego's."""
        if cell[1] > row:
            self.passed = tick if self.ahead and self.passed is None else self.passed
        elif cell[1] < row:
            self.ahead, self.passed = True, None
        if self.first is None:
            self.cell = cell
            if detected:
                self.first, self.rows = tick, row - cell[1]
        elif not detected and cell[1] < row:
            goes_on = self.lost and self.lost[-1][1] == tick - 1
            begun = self.lost.pop()[0] if goes_on else tick
            self.lost.append((begun, tick))


def sightings(timeline: Timeline) -> Sightings:
    """The things of the present drive of the first ego. Raises `QuestionError`: `too_long`."""
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    found = _looked_at(timeline.between(first, last + 1), first)
    told = (
        Sighting(
            id,
            each.kind,
            each.first,
            each.rows,
            each.cell,
            tuple(each.lost),
            each.there_at_first,
            each.passed,
        )
        for id, each in found.items()
    )
    return Sightings(first, last, tuple(sorted(told, key=_order)))


def _order(each: Sighting) -> tuple[bool, int, int]:
    """In the order of detection, of one tick the nearest first; what was never detected is last."""
    return each.first is None, each.first or 0, abs(each.rows)


def _looked_at(states: Iterable[SimState], first: int) -> dict[str, _Seen]:
    found: dict[str, _Seen] = {}
    for state in states:
        world, percept = state.world, sense(state)[0]
        row = world.road.cell(world.av)[1]
        for thing in world.things():
            if thing.kind is Kind.AV:
                continue
            if thing.id not in found:
                found[thing.id] = _Seen(thing.kind, thing.cell, world.tick == first)
            found[thing.id].look(world.tick, thing.cell, row, is_detected(percept, world, thing.id))
    return found


def noticed(timeline: Timeline, tick: int | None = None) -> Noticed:
    """What changed in what was detected at a tick, by default now. Raises `QuestionError`.

    `no_such_tick` for one that never was, `nothing_before` for the first of a drive.
    """
    now = timeline.tick
    at = now if tick is None else tick
    if at > now:
        raise QuestionError("no_such_tick", tick=at, now=now)
    state = timeline.at(at)
    if at <= state.world.episode_start:
        raise QuestionError("nothing_before", tick=at)
    before = timeline.at(at - 1)
    was, is_now = _detected(before), _detected(state)
    there = {thing.id for thing in state.world.things()}
    return Noticed(
        state,
        tuple(id for id in is_now if id not in was),
        tuple(id for id in was if id not in is_now and id in there),
    )


def _detected(state: SimState) -> list[str]:
    percept, world = sense(state)[0], state.world
    return [
        thing.id
        for thing in world.things()
        if thing.kind is not Kind.AV and is_detected(percept, world, thing.id)
    ]
