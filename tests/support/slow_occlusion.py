"""Occlusion by clipping every ray against every body in exact fractions: slow, and written another way."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from sim.types import KINDS, Cell, Kind


def ray_passes_through(start: Cell, end: Cell, kind: Kind, body: Cell) -> bool:
    """Whether the segment between two cell centres has more than a point inside a body (Liang & Barsky)."""
    size = KINDS[kind].size
    enter, leave = Fraction(0), Fraction(1)
    for axis in (0, 1):
        low, high = body[axis] - size[axis] / 2, body[axis] + size[axis] / 2
        way = end[axis] - start[axis]
        if way == 0:
            if not low < start[axis] < high:
                return False
            continue
        first, last = sorted(((low - start[axis]) / way, (high - start[axis]) / way))
        enter, leave = max(enter, first), min(leave, last)
    return enter < leave


def is_hidden(start: Cell, end: Cell, bodies: Iterable[tuple[Kind, Cell]]) -> bool:
    """Whether any body other than those in the two cells themselves hides one cell from another."""
    return any(
        ray_passes_through(start, end, kind, body) for kind, body in bodies if body not in (start, end)
    )
