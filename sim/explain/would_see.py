"""Whether one look of a sensor, in place of the present one, would detect the nearest thing of a kind."""

from __future__ import annotations

from dataclasses import dataclass, replace

from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing


@dataclass(frozen=True, slots=True)
class WouldSee:
    """The nearest thing that is really there in the ego's row or ahead, and how a sensor would see it."""

    thing: Thing
    chance: float | None
    """of one look from here; None for a sensor without tables (`SUITES`)"""
    in_view: bool
    """whether any device of it has the cell in range and view, and nothing hides it"""


def nearest_there(state: SimState, kind: Kind | None = None) -> Thing | None:
    """The nearest thing of a kind, or of any, that is really there, by the distance of cell centres."""
    column, row = state.world.road.cell(state.world.av)
    ahead = [
        each
        for each in state.world.things()
        if each.kind is not Kind.AV and kind in (None, each.kind) and each.cell[1] <= row
    ]
    return min(
        ahead,
        key=lambda each: ((each.cell[0] - column) ** 2 + (each.cell[1] - row) ** 2, each.id),
        default=None,
    )


def would_see(state: SimState, sensor: str, kind: Kind | None = None) -> WouldSee | None:
    """How a sensor would see the nearest thing of a kind; None where none is in the ego's row or ahead."""
    thing = nearest_there(state, kind)
    if thing is None:
        return None
    if sensor_named(sensor).faithful:
        return WouldSee(thing, 1.0, True)
    suite = SUITES.get(sensor)
    if suite is None:
        return WouldSee(thing, None, False)
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.grid_sensor import looks

    world, road = state.world, state.world.road
    column, row = road.cell(world.av)
    rows, place = row - thing.cell[1], thing.cell[0] - column + road.columns - 1
    missed, in_view = 1.0, False
    for each in looks(world, replace(state.config, sensor=sensor), 0, suite):
        if each.visible >> road.index(thing.cell) & 1:
            in_view = True
            missed *= 1.0 - each.model.kinds[thing.kind].detection[rows][place]
    return WouldSee(thing, 1.0 - missed, in_view)
