"""The empty road under everything: verges, asphalt, lines, start and finish; drawn once a size."""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.randomness import Stream
from sim.view import theme

GRAINS_A_CELL = 36
_GROUNDS = 8


@lru_cache(maxsize=_GROUNDS)
def ground(cell_px: int, verge_px: int, columns: int, rows: int) -> pygame.Surface:
    """The whole road as one tall picture, to be cut from."""
    size = (columns * cell_px + 2 * verge_px, rows * cell_px)
    picture = pygame.Surface(size)
    picture.fill(theme.VERGE)
    road = pygame.Rect(verge_px, 0, columns * cell_px, size[1])
    picture.fill(theme.ASPHALT, road)
    _grain(picture, road, columns * rows * GRAINS_A_CELL)
    _lines(picture, road, cell_px, columns)
    _finish(picture, road, cell_px)
    start = pygame.Rect(road.left, road.bottom - cell_px, road.width, max(2, cell_px // 30))
    picture.fill(theme.EDGE_LINE, start)
    return picture


def _grain(picture: pygame.Surface, road: pygame.Rect, count: int) -> None:
    draws = Stream.of(0, "asphalt")
    colours = theme.ASPHALT_GRAIN
    for n in range(count):
        word = draws.word(n)
        x, y = (
            road.left + (word & 0xFFFF) * road.width // 0x10000,
            (word >> 16 & 0xFFFFFF) * road.height >> 24,
        )
        picture.set_at((x, y), colours[(word >> 40) % len(colours)])


def _lines(picture: pygame.Surface, road: pygame.Rect, cell_px: int, columns: int) -> None:
    edge, dash = max(2, cell_px // 24), max(1, cell_px // 40)
    for x in (road.left, road.right - edge):
        picture.fill(theme.EDGE_LINE, (x, 0, edge, road.height))
    for column in range(1, columns):
        x = road.left + column * cell_px - dash // 2
        for y in range(cell_px // 4, road.height, cell_px):
            picture.fill(theme.LANE_LINE, (x, y, dash, cell_px // 2))


def _finish(picture: pygame.Surface, road: pygame.Rect, cell_px: int) -> None:
    square = max(2, cell_px // 6)
    for line in range(2):
        for n in range(road.width // square + 1):
            spot = pygame.Rect(road.left + n * square, cell_px - 2 * square + line * square, square, square)
            picture.fill(theme.FINISH[(n + line) % 2], spot.clip(road))
