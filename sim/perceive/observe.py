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
    shown = (
        *(percept.boards[kind] for kind in HAZARDS),
        percept.right,
        percept.left,
        *(percept.boards[kind] for kind in MARKED),
        percept.vehicles,
        road.all if steps_in_tick(PERIODS[Kind.PEDESTRIAN], percept.episode_tick) else 0,
    )
    # One integer with all planes one after the other: its digits are the array.
    cells, whole = road.columns * road.rows, 0
    for plane, board in enumerate(shown):
        whole |= board << plane * cells
    packed = np.frombuffer(whole.to_bytes((PLANES * cells + 7) // 8, "little"), np.uint8)
    planes = np.unpackbits(packed, count=PLANES * cells, bitorder="little")
    return planes.reshape(PLANES, road.rows, road.columns)
