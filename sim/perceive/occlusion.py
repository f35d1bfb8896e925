"""Occlusion: which cells a body hides from a vehicle, by casting rays from cell centre to cell centre.

A cell is hidden if the line from the centre of the vehicle's cell to its own centre passes through the inside
of a body of a kind that occludes (`KindSpec.occludes`), in the centre of another cell, of the size that
collisions are judged by. All numbers are whole (1/200 of a cell), so the test is exact. What a body hides
depends on where it is from the vehicle alone and is computed once.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Final

from sim.types import KINDS, Kind
from sim.world.grid import Board, Road, bits

UNIT: Final = 200
"""Units of length in a cell: half a hundredth, so that half a body is a whole number."""

Occluder = tuple[Kind, Board]
"""A kind that occludes, and the cells with bodies of it."""


def half_size(kind: Kind) -> tuple[int, int]:
    """Half of a body's extent across and along, in 1/200 of a cell."""
    size = KINDS[kind].size
    return int(size.across * UNIT / 2), int(size.along * UNIT / 2)


def ray_meets_body(target: tuple[int, int], body: tuple[int, int], half: tuple[int, int]) -> bool:
    """Whether the ray from (0, 0) to the centre of the cell `target` passes through the inside of a body.

    `target` and `body` are in cells from the vehicle. By separating axes: a segment and a box are apart if
    and only if they are apart across, along, or across the segment.
    """
    ray = target[0] * UNIT, target[1] * UNIT
    centre = body[0] * UNIT, body[1] * UNIT
    for axis in (0, 1):
        low, high = sorted((0, ray[axis]))
        if high <= centre[axis] - half[axis] or low >= centre[axis] + half[axis]:
            return False
    aside = abs(ray[0] * centre[1] - ray[1] * centre[0])
    return aside < half[0] * abs(ray[1]) + half[1] * abs(ray[0])


@lru_cache(maxsize=16_384)
def shadow(columns: int, column: int, reach: int, kind: Kind, across: int, ahead: int) -> Board:
    """The cells that one body hides from a vehicle in `column`, on a board whose last row is the vehicle's.

    The board has `reach` rows ahead of the vehicle; `across` columns to the right of it and `ahead` rows
    ahead is the body.
    """
    half, board = half_size(kind), 0
    body = across, -ahead
    for rows in range(ahead, reach + 1):
        row = (reach - rows) * columns
        for other in range(columns):
            there = other - column, -rows
            if there not in (body, (0, 0)) and ray_meets_body(there, body, half):
                board |= 1 << row + other
    return board


def hidden(road: Road, ego: int, reach: int, occluders: Iterable[Occluder]) -> Board:
    """Every cell that a body hides from the cell `ego`: in its row, and up to `reach` rows ahead."""
    columns = road.columns
    row, column = divmod(ego, columns)
    first = max(0, row - reach) * columns
    window = (1 << (row + 1) * columns) - 1
    board = 0
    for kind, cells in occluders:
        for cell in bits((cells & window) >> first):
            if cell + first == ego:
                continue
            body_row, body_column = divmod(cell + first, columns)
            board |= shadow(columns, column, reach, kind, body_column - column, row - body_row)
    above = (row - reach) * columns
    return board << above if above >= 0 else board >> -above
