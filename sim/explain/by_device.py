"""What each device alone reports: the draws of a device are its own, whatever sensor is chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.explain.would_see import nearest_there
from sim.perceive.parameters import SUITES
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing


@dataclass(frozen=True, slots=True)
class ByDevice:
    """The looks of one tick, device by device."""

    things: tuple[Thing, ...]
    """what is really in the ego's row or ahead, the nearest first"""
    seen: Mapping[str, frozenset[str]]
    """by device: the ids of these that it reports in this tick, be it in a cell beside"""
    alarms: Mapping[str, int]
    """by device: reports of what does not exist"""

    def seen_by(self, id: str) -> tuple[str, ...]:
        """The devices that report a thing."""
        return tuple(name for name, ids in self.seen.items() if id in ids)

    def only(self, device: str) -> tuple[Thing, ...]:
        """The things that no other device reports."""
        return tuple(each for each in self.things if self.seen_by(each.id) == (device,))

    def by_count(self, count: int) -> int:
        """How many things so many devices report."""
        return sum(len(self.seen_by(each.id)) == count for each in self.things)


@dataclass(frozen=True, slots=True)
class FirstByDevice:
    """When each device first reported a thing in this drive."""

    thing: Thing
    """as it is now"""
    first: Mapping[str, tuple[int, int] | None]
    """by device: the tick, and how many cells off it was then, across or along; None if it never did"""

    @property
    def order(self) -> tuple[str, ...]:
        """The devices that did, the earliest first."""
        found = {name: at[0] for name, at in self.first.items() if at is not None}
        return tuple(sorted(found, key=lambda name: found[name]))


def by_device(state: SimState) -> ByDevice:
    """What camera, lidar and radar each report in a state of what is there."""
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.grid_sensor import looks

    world = state.world
    column, row = world.road.cell(world.av)
    things = sorted(
        (each for each in world.things() if each.kind is not Kind.AV and each.cell[1] <= row),
        key=lambda each: ((each.cell[0] - column) ** 2 + (each.cell[1] - row) ** 2, each.id),
    )
    ids = {each.id for each in things}
    found = looks(world, state.config, 0, SUITES["fusion"])
    seen = {
        each.model.spec.name: frozenset(
            report.id for report in each.reports if report.id in ids and report.id
        )
        for each in found
    }
    alarms = {each.model.spec.name: sum(report.id is None for report in each.reports) for each in found}
    return ByDevice(tuple(things), seen, alarms)


def first_by_device(timeline: Timeline, kind: Kind | None = None) -> FirstByDevice | None:
    """When each device first reported the thing of a kind that is nearest now; None where none is ahead.

    Raises `QuestionError`: `too_long`.
    """
    thing = nearest_there(timeline.state, kind)
    if thing is None:
        return None
    world = timeline.state.world
    start, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - start > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - start, most=MOST_TICKS)
    first: dict[str, tuple[int, int] | None] = dict.fromkeys((spec.name for spec in SUITES["fusion"]), None)
    for state in timeline.between(start, last + 1):
        then = state.world.find(thing.id)
        if then is None:
            continue
        column, row = state.world.road.cell(state.world.av)
        for name in by_device(state).seen_by(thing.id):
            if first[name] is None:
                off = max(abs(then.cell[0] - column), abs(then.cell[1] - row))
                first[name] = state.world.tick, off
        if None not in first.values():
            break
    return FirstByDevice(thing, first)
