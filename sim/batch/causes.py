"""What a lane crashed into, read off the world after the crash and the move that led to it.

Lanes keep no world before the present one. The cell of a thing that was hit tells all. A mover passed
through, or that cut off a diagonal, stands where such a one does after the tick and faces the way it came.
"""

from __future__ import annotations

from typing import Final

from sim.types import Move, kind_of
from sim.world import Cause, World

_PASSING: Final = (Move.LEFT, Move.RIGHT, Move.FORWARD_LEFT, Move.FORWARD_RIGHT)


def cause_of_crash(world: World, move: Move | None) -> Cause | None:
    """The cause of a crash; `move`: the one that led to it, if it is known. None where nothing was met."""
    end, road = world.av, world.road
    for table in (world.hazards, world.movers):
        if end in table:
            return Cause("hit", kind_of(table[end]), (table[end],), road.cell(end))
    for passing in _PASSING if move is None else (move,):
        columns, rows = passing.offset
        start = end - columns - rows * road.columns
        if not columns or not 0 <= end % road.columns - columns < road.columns:
            continue
        coming = world.right if columns < 0 else world.left
        for cell in (start - road.columns, start) if rows else (start,):
            if cell in world.movers and coming >> cell & 1:
                name = world.movers[cell]
                how, where = ("cross", cell) if rows else ("swap", end)
                return Cause(how, kind_of(name), (name,), road.cell(where))
    return None
