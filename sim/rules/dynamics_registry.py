"""The motions there are, by name: a further one is added here."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Final

from sim.rules.dynamics import DEFAULT_DYNAMICS, Dynamics
from sim.rules.grid_dynamics import GridDynamics
from sim.world.grid import Road

DYNAMICS: Final[Mapping[str, type[Dynamics]]] = {each.name: each for each in (GridDynamics,)}
"""Every motion by its name in `Config.dynamics`."""

_latest: tuple[Road, str, bool, Dynamics] | None = None


def dynamics_on(road: Road, name: str = DEFAULT_DYNAMICS, bodies: bool = True) -> Dynamics:
    """The motion of that name on a road; mostly one object for the same question."""
    global _latest
    # The latest answer: it is asked for three times a tick, and even a look into a table adds up.
    latest = _latest
    if latest is not None and latest[0] is road and latest[1] == name and latest[2] is bodies:
        return latest[3]
    motion = _made(road.columns, road.rows, name, bodies)
    _latest = road, name, bodies, motion
    return motion


@lru_cache(maxsize=128)
def _made(columns: int, rows: int, name: str, bodies: bool) -> Dynamics:
    return DYNAMICS[name](Road.of(columns, rows), bodies=bodies)
