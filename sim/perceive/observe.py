"""A percept as arrays of cells, for what learns from them: environments, and planners that carry a network.

*Planes* (uint8, 0 or 1): potholes, barriers, movers heading right, movers heading left, pedestrians, the
autonomous vehicles, and in every cell whether pedestrians step in this tick. With courtesy 0 the next
observation follows from the whole road's planes and the action alone.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.perceive.percept import Percept
from sim.rules.traffic import pedestrians_walk
from sim.world.grid import bits

PLANES: Final = 7
POTHOLES, BARRIERS, RIGHT, LEFT, PEDESTRIANS, VEHICLE, STEPPING = range(PLANES)
"""Planes by number."""

Planes = NDArray[np.uint8]


def observe(percept: Percept) -> Planes:
    """The planes of what is seen (shape: 7, rows, columns)."""
    road = percept.road
    planes = np.zeros((PLANES, road.rows, road.columns), np.uint8)
    boards = (
        percept.potholes,
        percept.barriers,
        percept.right,
        percept.left,
        percept.pedestrians,
        percept.vehicles,
    )
    for plane, board in zip(planes, boards, strict=False):
        for cell in bits(board):
            plane.flat[cell] = 1
    planes[STEPPING] = pedestrians_walk(percept.episode_tick)
    return planes
