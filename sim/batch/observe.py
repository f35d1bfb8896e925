"""Lanes as arrays of cells, for those who learn from them (planes as in `sim.perceive.observe`)."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.layout import CELL, EPISODE_TICK, FIXED, HOLES, LANES, LEFT, PLANES, RIGHT, WALKERS
from sim.compilation import compiled

_ONE: Final = np.uint64(1)


@compiled
def observe(state, lanes, count, columns, rows, out):
    """Write every lane's planes into `out` (shape: lanes, 7, rows, columns; uint8).

    `state` (blocks, words · planes · lanes of a block; uint64) and `lanes` (blocks, lane planes · lanes of a
    block; uint64): see `sim.batch.layout`. `count`: lanes; those that fill the last block up are left out.
    """
    rows_per_word = 64 // columns
    for lane in range(count):
        block, inner = state[lane // LANES], lane % LANES
        lane_block, planes = lanes[lane // LANES], out[lane]
        beat = lane_block[EPISODE_TICK * LANES + inner] & _ONE
        for row in range(rows):
            at = row // rows_per_word * PLANES * LANES + inner
            shift = np.uint64(row % rows_per_word * columns)
            holes = block[at + HOLES * LANES] >> shift
            barriers = (block[at + FIXED * LANES] & ~block[at + HOLES * LANES]) >> shift
            right, left = block[at + RIGHT * LANES] >> shift, block[at + LEFT * LANES] >> shift
            walkers = block[at + WALKERS * LANES] >> shift
            for column in range(columns):
                bit = np.uint64(column)
                planes[0, row, column] = holes >> bit & _ONE
                planes[1, row, column] = barriers >> bit & _ONE
                planes[2, row, column] = right >> bit & _ONE
                planes[3, row, column] = left >> bit & _ONE
                planes[4, row, column] = walkers >> bit & _ONE
                planes[5, row, column] = 0
                planes[6, row, column] = beat
        cell = np.int64(lane_block[CELL * LANES + inner])
        planes[5, cell // columns, cell % columns] = 1
