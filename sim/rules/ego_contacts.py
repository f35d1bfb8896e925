"""When two egos touch within a tick: a table of where one is from the other, and both their moves.

Derived from the bodies (`sim.rules.collision_geometry`) once; the judge and the forecast read it.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Final, Literal, NamedTuple

from sim.rules.collision_geometry import Path, first_contact
from sim.types import Cell, Kind, Move
from sim.world.grid import Board, Road

REACH: Final = 2
"""Cells that two egos come closer by within a tick, at most: further apart they do not touch."""


@lru_cache(maxsize=2)
def ego_contacts(rule: Literal["swept", "cell"]) -> Mapping[Cell, frozenset[tuple[Cell, Cell]]]:
    """The moves by which two egos touch, by the other's cell as seen from the one.

    Moves are the (columns, rows) that they add to a cell: the one's own, then the other's.
    """
    near = range(-REACH, REACH + 1)
    table = {}
    for cell in ((across, along) for along in near for across in near if (across, along) != (0, 0)):
        found = frozenset(
            (own.offset, other.offset)
            for own in Move
            for other in Move
            if _touch(cell, own.offset, other.offset, rule)
        )
        if found:
            table[cell] = found
    return table


def _touch(cell: Cell, own: Cell, other: Cell, rule: Literal["swept", "cell"]) -> bool:
    end = (cell[0] + other[0], cell[1] + other[1])
    return paths_touch(((0, 0), own), (cell, end), rule)


def paths_touch(one: tuple[Cell, Cell], other: tuple[Cell, Cell], rule: Literal["swept", "cell"]) -> bool:
    """Whether two egos touch that go straight from a cell to another each, however far; (start, end)."""
    if rule == "cell":
        return one[1] == other[1] or (one[1] == other[0] and other[1] == one[0])
    return first_contact(Path(Kind.AV, *one), Path(Kind.AV, *other)) is not None


def egos_touch(
    road: Road, one: tuple[int, int], other: tuple[int, int], rule: Literal["swept", "cell"]
) -> bool:
    """Whether two egos touch that go from a cell to another each; cell indices, (start, end)."""
    columns = road.columns
    (from_row, from_column), (to_row, to_column) = divmod(one[0], columns), divmod(one[1], columns)
    (at_row, at_column), (end_row, end_column) = divmod(other[0], columns), divmod(other[1], columns)
    found = ego_contacts(rule).get((at_column - from_column, at_row - from_row), ())
    return ((to_column - from_column, to_row - from_row), (end_column - at_column, end_row - at_row)) in found


class Denied(NamedTuple):
    """For one move: the cells from which it touches another ego, and the cells that it would lead to."""

    starts: Board
    ends: Board


@lru_cache(maxsize=4_096)
def denied_steps(
    columns: int, rows: int, cell: int, move: Move, rule: Literal["swept", "cell"]
) -> tuple[Denied, ...]:
    """For every move, in the order of `Move`: what another ego denies, that makes `move` from `cell`."""
    row, column = divmod(cell, columns)
    found = []
    for own in Move:
        starts = ends = 0
        for (across, along), pairs in ego_contacts(rule).items():
            if (own.offset, move.offset) not in pairs:
                continue
            start = (column - across, row - along)
            end = (start[0] + own.offset[0], start[1] + own.offset[1])
            if all(0 <= x < columns and 0 <= y < rows for x, y in (start, end)):
                starts |= 1 << start[1] * columns + start[0]
                ends |= 1 << end[1] * columns + end[0]
        found.append(Denied(starts, ends))
    return tuple(found)
