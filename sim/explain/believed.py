"""The nearest thing that is believed in: how surely, which devices reported it, whether it is there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sim.decide import sense
from sim.explain.scene import Detection, describe_percept
from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import PLACEABLE, Cell, Kind
from sim.world import Thing

MOST_BACK = 20
"""Ticks that are looked back for the latest report of a thing."""


@dataclass(frozen=True, slots=True)
class Believed:
    """The nearest thing as it is seen, beside the truth."""

    faithful: bool
    """whether the sensor shows what is there"""
    thing: Detection | None
    """None where nothing of the kind is seen"""
    truth: Thing | None
    """what is really meant by it: the thing in its cell, else the one with its id, else None"""
    reported: int | None
    """the latest tick in which a device reported it; None where none did, or it is not known"""
    devices: tuple[str, ...]
    """the devices that did"""
    missed: Thing | None
    """the nearest thing that is there and not seen, where it is nearer than the one that is seen"""

    @property
    def is_there(self) -> bool:
        """Whether such a thing really is in that cell."""
        return self.truth is not None and self.thing is not None and self.truth.cell == self.thing.cell


def believed(timeline: Timeline, kind: Kind | None = None, *, ahead: bool = False) -> Believed:
    """The nearest thing of a kind, or of any, that the first ego believes in; `ahead`: in rows before it."""
    state = timeline.state
    faithful = sensor_named(state.config.sensor).faithful
    scene = describe_percept(sense(state)[0], state.config)
    seen = [each for each in scene.of(kind) if each.kind in PLACEABLE and (each.rows > 0 or not ahead)]
    thing = min(seen, key=lambda each: _order(each.lanes, each.rows), default=None)
    missed = None if faithful else _missed(state, kind, thing, ahead=ahead)
    if thing is None:
        return Believed(faithful, None, None, None, (), missed)
    reported, devices = _last_report(timeline, thing)
    return Believed(faithful, thing, _truth(state, thing), reported, devices, missed)


def _order(lanes: int, rows: int) -> tuple[int, int, bool]:
    """How far a thing is, in cells across or along the road; among equals the own lane, then ahead, first."""
    return max(abs(lanes), abs(rows)), abs(lanes), rows < 0


def _truth(state: SimState, seen: Detection) -> Thing | None:
    """The thing of the kind in the cell, else the one with the id, else None."""
    there = [each for each in state.world.things() if each.kind is seen.kind]
    found = next((each for each in there if each.cell == seen.cell), None)
    return found or next((each for each in there if each.id == seen.id), None)


def _missed(state: SimState, kind: Kind | None, seen: Detection | None, *, ahead: bool) -> Thing | None:
    """The nearest thing in no cell in which its kind is seen; None unless it is nearer than what is seen."""
    column, row = state.world.road.cell(state.world.av)
    shown = {(each.kind, each.cell) for each in sense(state)[0].things()}
    hidden = [
        each
        for each in state.world.things()
        if kind in (None, each.kind)
        and (each.kind, each.cell) not in shown
        and (each.cell[1] < row or not ahead)
    ]

    def order(cell: Cell) -> tuple[int, int, bool]:
        return _order(cell[0] - column, row - cell[1])

    nearest = min(hidden, key=lambda each: order(each.cell), default=None)
    if nearest is None or seen is None:
        return nearest
    return nearest if order(nearest.cell) < _order(seen.lanes, seen.rows) else None


def _last_report(timeline: Timeline, seen: Detection) -> tuple[int | None, tuple[str, ...]]:
    """The latest tick of this drive in which a device reported a thing, and the devices that did."""
    suite = SUITES.get(timeline.state.config.sensor)
    if suite is None:
        return None, ()
    for state in _looked_at(timeline):
        devices = reporting(state, seen.id, seen.kind, seen.cell)
        if devices:
            return state.world.tick, devices
    return None, ()


def _looked_at(timeline: Timeline) -> Iterator[SimState]:
    """The states whose looks the present belief is made of, the latest first."""
    state = timeline.state
    now, start = state.world.tick, state.world.episode_start
    if not (state.config.sensor_latency and now > start):  # a late look is not yet in the belief
        yield state
    before = list(timeline.between(max(start, now - MOST_BACK), now))
    yield from reversed(before)


def reporting(state: SimState, id: str, kind: Kind, cell: Cell) -> tuple[str, ...]:
    """The devices that report a thing in their look of a state, or one of its kind in the cell."""
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.grid_sensor import looks

    suite = SUITES.get(state.config.sensor, ())
    index = state.world.road.index(cell)
    return tuple(
        each.model.spec.name
        for each in looks(state.world, state.config, 0, suite)
        if any(report.kind is kind and (report.id == id or report.cell == index) for report in each.reports)
    )
