"""Draws what the ego came through and is about to do, and where movers are expected, as the page does."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Final

import pygame

from sim.decide import sense
from sim.forecast import predict
from sim.render import theme
from sim.render.camera import Camera
from sim.render.motion import Pose
from sim.rules.collision_geometry import SIZES
from sim.state import SimState
from sim.types import Cell, Kind, Move

AHEAD_TICKS: Final = 3
"""Ticks of the forecast that are drawn."""
_FINER: Final = 3
"""Marks are drawn so many times larger and scaled down, since pygame's shapes have hard edges."""
_HEAD: Final = ((0.15, -0.16), (0.0, 0.0), (0.15, 0.16))
"""An arrow head: how far behind its tip, how far aside, in cells."""
_FADES_FROM: Final = 0.7
"""Share of a step after which the mark of its move fades."""

_latest: tuple[SimState, str | None, tuple[dict[str, Cell], ...]] | None = None


def expected_cells(state: SimState, ego: str | None = None) -> tuple[dict[str, Cell], ...]:
    """Cells of the movers by id, in the ticks to come; the latest state is looked at once."""
    global _latest
    latest = _latest
    if latest is None or latest[0] is not state or latest[1] != ego:
        slices, road = predict(sense(state, id=ego)[0], AHEAD_TICKS).slices, state.world.road
        told = tuple(
            {name: road.cell(cell) for cell, name in slices.movers(ahead).items()}
            for ahead in range(AHEAD_TICKS)
        )
        latest = _latest = state, ego, told
    return latest[2]


def draw_forecast(
    picture: pygame.Surface, camera: Camera, poses: Iterable[Pose], ahead: Sequence[dict[str, Cell]]
) -> None:
    """Draws outlines of the movers where they are expected, the nearest tick the clearest."""
    layer = pygame.Surface(picture.get_size(), pygame.SRCALPHA)
    for pose in poses:
        kind, last = pose.thing.kind, pose.thing.cell[0]
        across, along = (round(float(side) * camera.cell_px) for side in SIZES[kind])
        radius, width = camera.cell_px // 12, max(1, camera.cell_px // 32)
        colour = theme.EXPECTED.get(kind, theme.colour_of(kind))
        for tick, cells in enumerate(ahead):
            cell = cells.get(pose.thing.id)
            if cell is None or cell[0] == last:
                continue
            last = cell[0]
            room = pygame.Rect(0, 0, across, along)
            room.center = camera.centre(cell[0], pose.row)
            clear = 0.95 - 0.3 * tick
            pygame.draw.rect(layer, (*colour, int(40 * clear)), room, border_radius=radius)
            pygame.draw.rect(layer, (*colour, int(255 * clear)), room, width, border_radius=radius)
    picture.blit(layer, (0, 0))


def draw_trail(picture: pygame.Surface, camera: Camera, cells: Sequence[Cell]) -> None:
    """Draws where the ego has been, fading with age; `cells` are the oldest first."""
    dot = _dot(max(4, camera.cell_px // 10))
    for number, (column, row) in enumerate(cells, 1):
        dot.set_alpha(int(217 * (number / len(cells)) ** 1.3))
        picture.blit(dot, dot.get_rect(center=camera.centre(column, row)))


@lru_cache(maxsize=8)
def _dot(px: int) -> pygame.Surface:
    fine = pygame.Surface((px * _FINER, px * _FINER), pygame.SRCALPHA)
    fine.fill((*theme.UNDER_WAY, 0))
    pygame.draw.circle(fine, theme.UNDER_WAY, fine.get_rect().center, px * _FINER // 2)
    return pygame.transform.smoothscale(fine, (px, px))


def draw_move(
    picture: pygame.Surface,
    camera: Camera,
    start: tuple[float, float],
    end: tuple[float, float],
    share: float,
    colour: theme.Colour,
) -> None:
    """Draws a band to the cell that a move leads to, with an arrow head; it fades as the move is done."""
    fade = _fade(share)
    way = pygame.Vector2(end) - pygame.Vector2(start)
    if fade <= 0 or way.length() < 0.01:
        return
    px = camera.cell_px
    reach, wide = round((way.length() + 0.6) * px), round(0.4 * px)
    arrow = _arrow(reach, wide, px, colour)
    arrow = pygame.transform.rotate(arrow, -pygame.Vector2(1, 0).angle_to(way))
    arrow.set_alpha(round(255 * fade))
    tail = pygame.Vector2(camera.centre(*start))
    picture.blit(arrow, arrow.get_rect(center=tail + way.normalize() * reach / 2))


@lru_cache(maxsize=64)
def _arrow(reach: int, wide: int, px: int, colour: theme.Colour) -> pygame.Surface:
    """A band that points right and grows clearer, and its arrow head; `px` is the side of a cell."""
    fine = pygame.Surface((reach * _FINER, wide * _FINER), pygame.SRCALPHA)
    fine.fill((*colour, 0))
    unit, middle = px * _FINER, wide * _FINER // 2
    tip = reach * _FINER - unit // 10
    band = tip - round(0.22 * unit)
    for x in range(band):
        half = round(0.15 * unit)
        pygame.draw.line(fine, (*colour, 87 * x // band), (x, middle - half), (x, middle + half))
    head = [(tip - round(back * unit), middle + round(aside * unit)) for back, aside in _HEAD]
    width = max(2, round(0.075 * unit))
    pygame.draw.lines(fine, (*colour, 242), False, head, width)
    for point in head:
        pygame.draw.circle(fine, (*colour, 242), point, width // 2)
    return pygame.transform.smoothscale(fine, (reach, wide))


def draw_wait(picture: pygame.Surface, camera: Camera, at: tuple[float, float], share: float) -> None:
    """Draws a bar across the way ahead: the ego stays."""
    fade = _fade(share)
    if fade <= 0:
        return
    x, y = camera.centre(*at)
    px = camera.cell_px
    bar = pygame.Rect(0, 0, round(0.5 * px), max(2, round(0.07 * px)))
    layer = pygame.Surface(bar.size, pygame.SRCALPHA)
    pygame.draw.rect(layer, (*theme.WAIT, int(255 * fade)), layer.get_rect(), border_radius=bar.height // 2)
    bar.center = (x, y - round(0.56 * px))
    picture.blit(layer, bar)


def draw_intent(
    picture: pygame.Surface, camera: Camera, at: tuple[float, float], to: Cell, move: Move, share: float
) -> None:
    """Draws the move under way: from where the ego is drawn to the cell it leads to."""
    if move is Move.STAY:
        draw_wait(picture, camera, at, share)
    else:
        draw_move(picture, camera, at, to, share, theme.UNDER_WAY)


def draw_next(picture: pygame.Surface, camera: Camera, at: Cell, move: Move) -> None:
    """Draws the move that comes next, while nothing moves."""
    columns, rows = move.offset
    if move is Move.STAY:
        draw_wait(picture, camera, at, 0.0)
    else:
        draw_move(picture, camera, at, (at[0] + columns, at[1] + rows), 0.0, theme.NEXT)


def movers(poses: Iterable[Pose]) -> list[Pose]:
    """Those of things that move by themselves."""
    return [pose for pose in poses if pose.thing.kind.moves and pose.thing.kind is not Kind.AV]


def _fade(share: float) -> float:
    return 1.0 - max(0.0, share - _FADES_FROM) / (1.0 - _FADES_FROM)
