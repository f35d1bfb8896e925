"""The space of scenarios that is searched: how dense a road is, how much moves on it, how things are placed.

A point of the space has a level from 0 to 1 for each kind of thing and a layout; with a seed it is a road.
The grid, the clock, the sensor, the weather and how others behave stay as the search was given them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, get_args

from sim.actions import Layout
from sim.config import COUNTS, Config, ConfigError
from sim.types import Kind
from sim.world.layouts import has_barriers, min_free_cells

KINDS_SEARCHED: Final = tuple(COUNTS)
"""The kinds whose numbers are searched, in the order of `Point.levels`."""
LAYOUTS: Final[tuple[Layout | None, ...]] = (None, *get_args(Layout))
"""The layouts that are searched, in the order of their numbers; None: things are scattered."""
FIXED_MOST: Final = {Kind.POTHOLE: 0.25}
"""Largest share of cells that things of a fixed kind take; `FIXED_OTHER` of the others."""
FIXED_OTHER: Final = 0.10
MOVING_MOST: Final = {Kind.VEHICLE: 1.2}
"""Most movers of a kind in each row; `MOVING_OTHER` of the others."""
MOVING_OTHER: Final = 0.4
FULLEST: Final = 0.25
"""Largest share of the free cells of a layout that things take: a fuller one is seldom drivable, and is drawn
again and again."""


@dataclass(frozen=True, slots=True)
class Point:
    """A point of the space."""

    levels: tuple[float, ...]
    """0 to 1 for each kind of `KINDS_SEARCHED`"""
    layout: int
    """place in `LAYOUTS`"""


def config_at(base: Config, point: Point, seed: int) -> Config | None:
    """The configuration of the road at a point; None where no such road fits."""
    layout = LAYOUTS[point.layout]
    counts = {
        COUNTS[kind]: round(level * _most(kind, base))
        for kind, level in zip(KINDS_SEARCHED, point.levels, strict=True)
    }
    if has_barriers(layout):
        counts[COUNTS[Kind.BARRIER]] = 0
    room = min_free_cells(layout, base.columns, base.rows)
    if layout is not None:
        room = int(FULLEST * room)
    if (wanted := sum(counts.values())) > room:
        counts = {name: count * room // wanted for name, count in counts.items()}
    try:
        return base.with_parts(layout=layout, road=None, traffic=None, solvable=False, seed=seed, **counts)
    except ConfigError:
        return None


def _most(kind: Kind, base: Config) -> float:
    """The number of things at level 1."""
    rows = base.rows - 2
    if kind.fixed:
        return FIXED_MOST.get(kind, FIXED_OTHER) * base.columns * rows
    return MOVING_MOST.get(kind, MOVING_OTHER) * rows
