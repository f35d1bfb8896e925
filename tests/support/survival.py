"""How long a vehicle can keep clear of collisions, searched over the slow twin of the rules and nothing else.

No mover is taken to brake, so what is found possible is possible all the same.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from sim.types import Cell
from tests.support.twin import EGO, STEPS, Body, Position, Size, moved_bodies, together


def cells_after(now: Position, ticks: int) -> set[Cell]:
    """The cells in which a vehicle can be after so many ticks that met nothing; row 0 ends the way."""
    here, arrived = {now.av}, set[Cell]()
    for _ in range(ticks):
        later = moved_bodies(now)
        here = {there for cell in here for there in _steps(now, later, cell)}
        arrived |= {cell for cell in here if cell[1] == 0}
        here -= arrived
        if not here:
            break
        now = _after(now, later)
    return here | arrived


def can_avoid(now: Position, ticks: int) -> bool:
    """Whether some way from here arrives or meets nothing for so many ticks."""
    return bool(cells_after(now, ticks))


def clear_after(now: Position, cell: Cell, ticks: int, *, stays: bool) -> bool:
    """Whether a step into a cell meets nothing, and some way on from there; `stays`: for good."""
    later = moved_bodies(now)
    if cell not in _steps(now, later, now.av):
        return False
    now = replace(_after(now, later), av=cell)
    if not stays:
        return cell[1] == 0 or can_avoid(now, ticks)
    for _ in range(ticks):
        later = moved_bodies(now)
        if cell not in _steps(now, later, cell):
            return False
        now = _after(now, later)
    return True


def _after(now: Position, later: tuple[Body, ...]) -> Position:
    return Position(
        now.columns,
        now.rows,
        now.tick + 1,
        now.episode_tick + 1,
        now.av,
        now.potholes,
        now.barriers,
        later,
    )


def _steps(now: Position, later: tuple[Body, ...], cell: Cell) -> list[Cell]:
    ends = [(cell[0] + columns, cell[1] + rows) for columns, rows in STEPS.values()]
    near = [
        (before, after)
        for before, after in zip(now.bodies, later, strict=True)
        if max(abs(before.cell[0] - cell[0]), abs(before.cell[1] - cell[1])) <= 2
    ]
    return [
        end
        for end in ends
        if now.holds(end)
        and end not in now.fixed
        and not any(_touch(cell, end, before.cell, after.cell, before.size) for before, after in near)
    ]


def _touch(begin: Cell, end: Cell, body: Cell, later: Cell, size: Size) -> bool:
    def seen(cell: Cell) -> Cell:
        return cell[0] - begin[0], cell[1] - begin[1]

    return _touching(seen(end), seen(body), seen(later), size)


@cache
def _touching(end: Cell, body: Cell, later: Cell, size: Size) -> bool:
    return together(((0, 0), end), EGO, (body, later), size)
