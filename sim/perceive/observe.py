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
from sim.rules.mover_boards import PERIODS
from sim.rules.traffic import steps_in_tick
from sim.types import HAZARDS, MARKED, Kind
from sim.world.grid import bits

ORDER: Final = (*HAZARDS, "right", "left", *MARKED, Kind.AV, "stepping")
"""What each plane shows."""
PLANES: Final = len(ORDER)
POTHOLES, BARRIERS, RIGHT, LEFT, PEDESTRIANS, VEHICLE, STEPPING = (
    ORDER.index(name)
    for name in (Kind.POTHOLE, Kind.BARRIER, "right", "left", Kind.PEDESTRIAN, Kind.AV, "stepping")
)
"""Planes by number. Kinds that come later have planes between these."""

Planes = NDArray[np.uint8]


def observe(percept: Percept) -> Planes:
    """The planes of what is seen (shape: planes, rows, columns; the planes are those of `ORDER`)."""
    road = percept.road
    planes = np.zeros((PLANES, road.rows, road.columns), np.uint8)
    boards = (
        *(percept.boards[kind] for kind in HAZARDS),
        percept.right,
        percept.left,
        *(percept.boards[kind] for kind in MARKED),
        percept.vehicles,
    )
    for plane, board in zip(planes, boards, strict=False):
        for cell in bits(board):
            plane.flat[cell] = 1
    planes[STEPPING] = steps_in_tick(PERIODS[Kind.PEDESTRIAN], percept.episode_tick)
    return planes
