"""Draws the empty road: verges, asphalt, lines, start and finish.

A tile of a few rows is drawn once per size and repeated, so a long road costs no more than a short one.
"""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.randomness import Stream
from sim.render import theme
from sim.render.camera import Camera

GRAINS_A_CELL = 36
TILE_ROWS = 4
_TILES = 8


def draw_ground(picture: pygame.Surface, camera: Camera, rows: int, *, light: bool = False) -> None:
    """Draws the part of a road of `rows` rows that the camera sees, by day colours where `light`."""
    tile = _tile(camera.cell_px, camera.verge_px, camera.columns, light=light)
    top = round(camera.top * camera.cell_px)
    for y in range(-(top % tile.get_height()), picture.get_height(), tile.get_height()):
        picture.blit(tile, (0, y))
    road = pygame.Rect(camera.verge_px, -top, camera.columns * camera.cell_px, rows * camera.cell_px)
    if road.top + camera.cell_px > 0:
        _finish(picture, road, camera.cell_px)
    start = pygame.Rect(road.left, road.bottom - camera.cell_px, road.width, max(2, camera.cell_px // 30))
    picture.fill(theme.EDGE_LINE, start)


@lru_cache(maxsize=_TILES)
def _tile(cell_px: int, verge_px: int, columns: int, *, light: bool) -> pygame.Surface:
    """Draws a tile: some rows of road between start and finish, to be repeated."""
    size = (columns * cell_px + 2 * verge_px, TILE_ROWS * cell_px)
    picture = pygame.Surface(size)
    picture.fill(theme.VERGE_LIGHT if light else theme.VERGE)
    road = pygame.Rect(verge_px, 0, columns * cell_px, size[1])
    picture.fill(theme.ASPHALT_LIGHT if light else theme.ASPHALT, road)
    grain = theme.ASPHALT_GRAIN_LIGHT if light else theme.ASPHALT_GRAIN
    _grain(picture, road, columns * TILE_ROWS * GRAINS_A_CELL, grain)
    _lines(picture, road, cell_px, columns, theme.LANE_LINE_LIGHT if light else theme.LANE_LINE)
    return picture


def _grain(picture: pygame.Surface, road: pygame.Rect, count: int, colours: tuple[theme.Colour, ...]) -> None:
    draws = Stream.of(0, "asphalt")
    for n in range(count):
        word = draws.word(n)
        x, y = (
            road.left + (word & 0xFFFF) * road.width // 0x10000,
            (word >> 16 & 0xFFFFFF) * road.height >> 24,
        )
        picture.set_at((x, y), colours[(word >> 40) % len(colours)])


def _lines(
    picture: pygame.Surface, road: pygame.Rect, cell_px: int, columns: int, lane: theme.Colour
) -> None:
    edge, dash = max(2, cell_px // 24), max(1, cell_px // 40)
    for x in (road.left, road.right - edge):
        picture.fill(theme.EDGE_LINE, (x, 0, edge, road.height))
    for column in range(1, columns):
        x = road.left + column * cell_px - dash // 2
        for y in range(cell_px // 4, road.height, cell_px):
            picture.fill(lane, (x, y, dash, cell_px // 2))


def _finish(picture: pygame.Surface, road: pygame.Rect, cell_px: int) -> None:
    square = max(2, cell_px // 6)
    for line in range(2):
        for n in range(road.width // square + 1):
            y = road.top + cell_px - (2 - line) * square
            spot = pygame.Rect(road.left + n * square, y, square, square)
            picture.fill(theme.FINISH[(n + line) % 2], spot.clip(road))
