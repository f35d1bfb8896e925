"""Marks what the vehicle does not see, and what it sees and is not there; nothing with a faithful sensor."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NamedTuple

import pygame

from sim.decide import sense
from sim.perceive import sensor_named
from sim.render.camera import Camera
from sim.state import SimState
from sim.types import Cell

_UNSEEN: Final = (240, 240, 240)
_MADE_UP: Final = (255, 120, 120)
_DASHES: Final = 12


class Marks(NamedTuple):
    """Cells with something that is not seen there, and cells in which something is seen that is not there."""

    unseen: tuple[Cell, ...]
    made_up: tuple[Cell, ...]


NOTHING: Final = Marks((), ())


_latest: tuple[SimState, str | None, Marks] | None = None


def marks_of(state: SimState, ego: str | None = None) -> Marks:
    """What there is to mark at a tick, from the vehicle's row on; the latest state is looked at once."""
    global _latest
    if sensor_named(state.config.sensor).faithful:
        return NOTHING
    latest = _latest
    if latest is None or latest[0] is not state or latest[1] != ego:
        latest = _latest = state, ego, _found(state, ego)
    return latest[2]


def _found(state: SimState, ego: str | None) -> Marks:
    world = state.world
    row = world.road.cell(world.avs[state.number(ego)])[1]
    seen = {(thing.kind, thing.cell) for thing in sense(state, id=ego)[0].things()}
    there = {(thing.kind, thing.cell) for thing in world.things()}
    return Marks(
        tuple(sorted(cell for _, cell in there - seen if cell[1] <= row)),
        tuple(sorted(cell for _, cell in seen - there if cell[1] <= row)),
    )


def draw_marks(picture: pygame.Surface, camera: Camera, marks: Marks) -> None:
    """Draws a dashed ring round what is not seen, and a cross where something is made up."""
    for column, row in _shown(camera, marks.unseen):
        _ring(picture, camera.centre(column, row), camera.cell_px * 2 // 5)
    for column, row in _shown(camera, marks.made_up):
        x, y = camera.centre(column, row)
        arm, width = camera.cell_px // 4, max(1, camera.cell_px // 24)
        pygame.draw.line(picture, _MADE_UP, (x - arm, y - arm), (x + arm, y + arm), width)
        pygame.draw.line(picture, _MADE_UP, (x - arm, y + arm), (x + arm, y - arm), width)


def _shown(camera: Camera, cells: Iterable[Cell]) -> Iterable[Cell]:
    return (cell for cell in cells if camera.sees(cell[1]))


def _ring(picture: pygame.Surface, centre: tuple[int, int], radius: int) -> None:
    arm = pygame.Vector2(radius, 0)
    for dash in range(_DASHES):
        start, end = (arm.rotate(360 / _DASHES * (dash + share)) + centre for share in (0.0, 0.5))
        pygame.draw.line(picture, _UNSEEN, start, end, max(1, radius // 10))
