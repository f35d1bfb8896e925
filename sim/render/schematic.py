"""Draws the schematic: the whole road, one small square per cell."""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.render import theme
from sim.render.theme import MAX_SIDE_PX, Colour
from sim.state import SimState
from sim.types import KINDS, Kind

CELL_PX = 24
_ROUND = ("pothole", "pedestrian")
"""What is drawn as a disc."""


def draw_schematic(state: SimState, size: tuple[int, int] | None) -> pygame.Surface:
    """See `sim.render.render`."""
    road = state.world.road
    width, height = size or (MAX_SIDE_PX, MAX_SIDE_PX)
    fitting = max(1, min(width // road.columns, height // road.rows))
    px = min(fitting, CELL_PX) if size is None else fitting
    picture = _empty(road.columns, road.rows, px).copy()
    for thing in state.world.things():
        _spot(picture, thing.kind, thing.cell, px, theme.colour_of(thing.kind))
    for number, index in enumerate(state.world.avs):
        _spot(picture, Kind.AV, road.cell(index), px, theme.colour_of_ego(number))
    return picture


@lru_cache(maxsize=4)
def _empty(columns: int, rows: int, px: int) -> pygame.Surface:
    picture = pygame.Surface((columns * px, rows * px))
    picture.fill(theme.SCHEMATIC_GRID)
    gap = 1 if px >= 6 else 0
    for row in range(rows):
        for column in range(columns):
            colour = theme.FINISH[column % 2] if row == 0 else theme.SCHEMATIC_ROAD
            picture.fill(colour, (column * px, row * px, px - gap, px - gap))
    return picture


def _spot(picture: pygame.Surface, kind: Kind, cell: tuple[int, int], px: int, colour: Colour) -> None:
    inset = max(0, px // 8)
    spot = pygame.Rect(cell[0] * px, cell[1] * px, px, px).inflate(-2 * inset, -2 * inset)
    if KINDS[kind].sprite in _ROUND:
        pygame.draw.ellipse(picture, colour, spot)
    else:
        pygame.draw.rect(picture, colour, spot, border_radius=px // 5)
