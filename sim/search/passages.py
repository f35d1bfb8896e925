"""The ways past what never moves: from which cells the goal can be reached, and how far aside the way on is.

Structure: one pass over the rows from the goal back, on bits of rows; then levels of cells by distance, on
whole boards. The answers for the latest roads are kept, by value, so that a decision looks them up.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from sim.rules.ego_step import beside
from sim.world.grid import Board, Road

KEPT: Final = 8_192
"""Roads whose ways are kept: those of all live sessions of a process, which ask in turn, and of explanations.

Where there are more sessions than roads are kept, none is found again. A usual road takes some 700 bytes."""


@dataclass(frozen=True, slots=True)
class Ways:
    """What leads to the goal past all that never moves."""

    still: Board
    """cells that are taken for good"""
    open: Board
    """the others from which moves lead to row 0, those of row 0 included"""
    levels: tuple[Board, ...]
    """the open cells by the columns to go aside to a way on (`columns_aside`)"""

    def columns_aside(self, cell: int) -> int | None:
        """The fewest columns from a cell, in its row and by a diagonal, to an open cell of the next row.

        0 where the cell straight ahead is open, and in row 0; None where no way leads on.
        """
        for columns, level in enumerate(self.levels):
            if level >> cell & 1:
                return columns
        return None


@lru_cache(maxsize=KEPT)
def ways_past(columns: int, rows: int, still: Board) -> Ways:
    """The ways on a road of that size past the cells of `still`."""
    road = Road.of(columns, rows)
    left_edge, right_edge = road.left_edge, road.right_edge
    free = road.all & ~still
    mask = (1 << columns) - 1
    reached = free & mask
    found = reached
    for row in range(1, rows):
        row_free = free >> row * columns & mask
        if not reached:
            break
        if reached == mask:
            reached = row_free
        else:
            reached = _filled(row_free, (reached | reached << 1 | reached >> 1) & row_free)
        found |= reached << row * columns
    level = (found << columns | found & mask) & found
    left = found & ~level
    levels = [level]
    aslant = beside(found, left_edge, right_edge) << columns
    level = (aslant | beside(level, left_edge, right_edge)) & left
    while level:
        levels.append(level)
        left ^= level
        level = beside(level, left_edge, right_edge) & left
    return Ways(still, found, tuple(levels))


@lru_cache(maxsize=4_096)
def _filled(free: Board, seeds: Board) -> Board:
    """The stretches of free cells of a row that hold a seed."""
    while True:
        grown = (seeds | seeds << 1 | seeds >> 1) & free
        if grown == seeds:
            return seeds
        seeds = grown


def locked_in(movers: Board, fixed: Board, left_edge: Board, right_edge: Board) -> Board:
    """The movers that can never leave their cell: the edge, something fixed or another such on both sides."""
    # A mover never enters a cell that another stands in, so a row of them between two walls is a wall.
    locked = movers
    while True:
        still = fixed | locked
        kept = locked & (still << 1 | left_edge) & (still >> 1 | right_edge)
        if kept == locked:
            return locked
        locked = kept
