"""Draws the occupancy grid: 0 for a free cell, 1 for an occupied one, coloured by kind."""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.render import theme
from sim.render.text import render_text
from sim.render.theme import MAX_SIDE_PX
from sim.state import SimState

CELL_PX = 24
MIN_DIGIT_PX = 8
"""Smaller cells have no digits, since they could not be read."""


def draw_occupancy(state: SimState, size: tuple[int, int] | None = None) -> pygame.Surface:
    """Draws every cell of the road; `size` is the largest (width, height) in pixels."""
    road = state.world.road
    width, height = size or (MAX_SIDE_PX, MAX_SIDE_PX)
    fitting = max(1, min(width // road.columns, height // road.rows))
    px = min(fitting, CELL_PX) if size is None else fitting
    picture = _zeros(road.columns, road.rows, px).copy()
    for thing in state.world.things():
        _one(picture, theme.colour_of(thing.kind), thing.cell, px)
    for number, index in enumerate(state.world.avs):
        _one(picture, theme.colour_of_ego(number), road.cell(index), px)
    return picture


@lru_cache(maxsize=4)
def _zeros(columns: int, rows: int, px: int) -> pygame.Surface:
    picture = pygame.Surface((columns * px, rows * px))
    picture.fill(theme.SCHEMATIC_GRID)
    for row in range(rows):
        for column in range(columns):
            _digit(picture, "0", theme.ZERO, theme.SCHEMATIC_ROAD, (column, row), px)
    return picture


def _one(picture: pygame.Surface, colour: theme.Colour, cell: tuple[int, int], px: int) -> None:
    _digit(picture, "1", theme.ON_KIND, colour, cell, px)


def _digit(
    picture: pygame.Surface,
    digit: str,
    ink: theme.Colour,
    paper: theme.Colour,
    cell: tuple[int, int],
    px: int,
) -> None:
    gap = 1 if px >= 6 else 0
    box = pygame.Rect(cell[0] * px, cell[1] * px, px - gap, px - gap)
    picture.fill(paper, box)
    if px >= MIN_DIGIT_PX:
        sign = render_text(digit, max(10, px * 4 // 5), ink)
        picture.blit(sign, sign.get_rect(center=(box.centerx, box.centery + 1)))
