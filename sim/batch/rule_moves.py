"""The decisions of `rules` in every lane of a batch, in compiled words.

Structure: the rows from the goal to the vehicle are taken out of a lane's words, since the ranking looks at
them one by one (`sim.batch.row_rules`). Guarantee: the moves of `sim.plan.rule_based`. Arguments: as in
`sim.batch.reachability`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import pedestrians_walk
from sim.batch.drawn_reactions import drawn_beside
from sim.batch.layout import (
    ATTENTIVE,
    ATTENTIVE_KEY,
    CELL,
    COLUMN_BIT,
    COURTESY,
    COURTESY_KEY,
    EPISODE_TICK,
    FIXED,
    HOLES,
    LANES,
    LEFT,
    OUTCOME,
    PLANES,
    RIGHT,
    SWEPT,
    WALKERS,
)
from sim.batch.row_motion import CAME_LEFT as ROW_CAME_LEFT
from sim.batch.row_motion import CAME_RIGHT as ROW_CAME_RIGHT
from sim.batch.row_motion import LEFT as ROW_LEFT
from sim.batch.row_motion import RIGHT as ROW_RIGHT
from sim.batch.row_motion import STAY, braked_motion, free_moves, row_motion
from sim.batch.row_rules import by_rank, find_ways
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def _row_of(block, plane, lane, row, columns, whole):
    """A row of a lane's board."""
    rows_per_word = 64 // columns
    word, shift = row // rows_per_word, row % rows_per_word * columns
    return block[(word * PLANES + plane) * LANES + lane] >> np.uint64(shift) & whole


@compiled
def ruled_moves(state, lanes, shares, columns, rows, count, moves):
    """For every lane the move of the rule-based planner."""
    last_bit = _ONE << np.uint64(columns - 1)
    whole = (last_bit - _ONE) | last_bit
    fixed, movers = np.empty(rows, np.uint64), np.empty(rows, np.uint64)
    ways = np.empty((3, rows, columns), np.int16)
    on = np.empty(5, np.uint64)
    for lane in range(count):
        block, inner = state[lane // LANES], lane % LANES
        lane_block = lanes[lane // LANES]
        moves[lane] = STAY
        if lane_block[OUTCOME * LANES + inner]:
            continue
        cell = np.int64(lane_block[CELL * LANES + inner])
        row, column = cell // columns, cell % columns
        for each in range(row + 1):
            fixed[each] = _row_of(block, FIXED, inner, each, columns, whole)
            movers[each] = _row_of(block, RIGHT, inner, each, columns, whole)
            movers[each] |= _row_of(block, LEFT, inner, each, columns, whole)
        find_ways(ways, movers, fixed, row + 1, columns, last_bit)
        tick = np.int64(lane_block[EPISODE_TICK * LANES + inner])
        bit, walking = lane_block[COLUMN_BIT * LANES + inner], pedestrians_walk(tick)
        ahead = row_motion(
            _row_of(block, RIGHT, inner, row - 1, columns, whole),
            _row_of(block, LEFT, inner, row - 1, columns, whole),
            _row_of(block, WALKERS, inner, row - 1, columns, whole),
            _row_of(block, HOLES, inner, row - 1, columns, whole),
            fixed[row - 1],
            _ZERO,
            _ZERO,
            walking,
            last_bit,
        )
        on[ROW_RIGHT], on[ROW_LEFT] = ahead.right, ahead.left
        on[ROW_CAME_RIGHT], on[ROW_CAME_LEFT] = ahead.came_right, ahead.came_left
        key, share = lane_block[COURTESY_KEY * LANES + inner], shares[lane, COURTESY]
        yields = drawn_beside(key, tick, cell, bit, last_bit, share)
        key, share = lane_block[ATTENTIVE_KEY * LANES + inner], shares[lane, ATTENTIVE]
        brakes = drawn_beside(key, tick, cell, bit, last_bit, share)
        motion = row_motion(
            _row_of(block, RIGHT, inner, row, columns, whole),
            _row_of(block, LEFT, inner, row, columns, whole),
            _row_of(block, WALKERS, inner, row, columns, whole),
            _row_of(block, HOLES, inner, row, columns, whole),
            fixed[row],
            yields,
            bit,
            walking,
            last_bit,
        )
        braked, swept = braked_motion(motion, bit, brakes), lane_block[SWEPT * LANES + inner]
        free = free_moves(bit, motion, braked, fixed[row], on, fixed[row - 1], swept, last_bit)
        moves[lane] = by_rank(free, ways, row, column, columns, motion, on)
