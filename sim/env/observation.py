"""What a learner is shown and paid, the same for one world and for many.

An observation has seven planes of rows × columns cells (uint8, 0 or 1): potholes, barriers, movers heading
right, movers heading left, pedestrians, the vehicle, and in every cell whether pedestrians step in this tick.
With courtesy 0 the next observation follows from it and the action alone.

The reward of a tick is the rows gained over all rows to gain, and +1 on arrival or −1 for a crash, less the
tick's share of the longest episode; driving straight to the goal is worth almost 2.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.config import Config
from sim.kinds import Kind
from sim.road import bits
from sim.rules import pedestrians_walk
from sim.world import World

PLANES: Final = 7
ARRIVED: Final = 1.0
CRASHED: Final = -1.0


def observed(world: World) -> NDArray[np.uint8]:
    """One world's planes (shape: 7, rows, columns)."""
    road = world.road
    planes = np.zeros((PLANES, road.rows, road.columns), np.uint8)
    boards = (
        world.potholes,
        world.barriers,
        world.right,
        world.left,
        world.pedestrians,
        world.board(Kind.AV),
    )
    for plane, board in zip(planes, boards, strict=False):
        for cell in bits(board):
            plane.flat[cell] = 1
    planes[6] = pedestrians_walk(world.episode_tick)
    return planes


def rewards(
    rows_gained: NDArray[np.int64], arrived: NDArray[np.bool_], crashed: NDArray[np.bool_], config: Config
) -> NDArray[np.float64]:
    """What a tick is worth (shape: lanes)."""
    share = 1.0 / config.max_ticks
    paid: NDArray[np.float64] = (
        rows_gained / (config.rows - 1) + ARRIVED * arrived + CRASHED * crashed - share
    )
    return paid
