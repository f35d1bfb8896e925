"""Many decisions of `priority` or `rules` at once, from what is seen otherwise, in compiled words.

Guarantee: the moves of the planners. Arguments: as in `sim.batch.row_motion` and `sim.batch.row_rules`;
besides

- `seen` (ways to see, 7, words; uint64): boards in the order of `SEEN_RIGHT`, as they are in memory: cell by
  cell, 64 to a word, with an empty word behind the last;
- `moves` (ways to see; uint8): the answers, places in `MOVES`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import pedestrians_walk
from sim.batch.row_motion import (
    CAME_LEFT,
    CAME_RIGHT,
    LEFT,
    RIGHT,
    braked_motion,
    free_moves,
    row_motion,
)
from sim.batch.row_rules import PRIORITY, RULES, find_ways, made_move
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
SEEN_RIGHT, SEEN_LEFT, SEEN_WALKERS, SEEN_FIXED, SEEN_HOLES, SEEN_YIELDS, SEEN_BRAKES = range(7)
SEEN: Final = 7


@compiled
def _row_of(board, row, columns, whole):
    """A row of a board."""
    word, shift = row * columns // 64, row * columns % 64
    found = board[word] >> np.uint64(shift)
    if shift + columns > 64:
        found |= board[word + 1] << np.uint64(64 - shift)
    return found & whole


@compiled
def ranked_moves(seen, cell, columns, last_bit, episode_tick, swept, planner, moves):
    """Write the move that is made where each of these is seen."""
    row, column = cell // columns, cell % columns
    bit, whole = _ONE << np.uint64(column), (last_bit - _ONE) | last_bit
    walking = pedestrians_walk(episode_tick)
    ways = np.empty((3, row + 1, columns), np.int16)
    fixed, movers = np.empty(row + 1, np.uint64), np.empty(row + 1, np.uint64)
    on = np.empty(5, np.uint64)
    for number in range(seen.shape[0]):
        now = seen[number]
        first = row - 1 if planner == PRIORITY else 0
        for each in range(first, row + 1):
            fixed[each] = _row_of(now[SEEN_FIXED], each, columns, whole)
            movers[each] = _row_of(now[SEEN_RIGHT], each, columns, whole)
            movers[each] |= _row_of(now[SEEN_LEFT], each, columns, whole)
        ahead = row_motion(
            _row_of(now[SEEN_RIGHT], row - 1, columns, whole),
            _row_of(now[SEEN_LEFT], row - 1, columns, whole),
            _row_of(now[SEEN_WALKERS], row - 1, columns, whole),
            _row_of(now[SEEN_HOLES], row - 1, columns, whole),
            fixed[row - 1],
            _ZERO,
            _ZERO,
            walking,
            last_bit,
        )
        on[RIGHT], on[LEFT] = ahead.right, ahead.left
        on[CAME_RIGHT], on[CAME_LEFT] = ahead.came_right, ahead.came_left
        motion = row_motion(
            _row_of(now[SEEN_RIGHT], row, columns, whole),
            _row_of(now[SEEN_LEFT], row, columns, whole),
            _row_of(now[SEEN_WALKERS], row, columns, whole),
            _row_of(now[SEEN_HOLES], row, columns, whole),
            fixed[row],
            _row_of(now[SEEN_YIELDS], row, columns, whole),
            bit,
            walking,
            last_bit,
        )
        braked = braked_motion(motion, bit, _row_of(now[SEEN_BRAKES], row, columns, whole))
        free = free_moves(bit, motion, braked, fixed[row], on, fixed[row - 1], swept, last_bit)
        if planner == RULES:
            find_ways(ways, movers, fixed, row + 1, columns, last_bit)
        moves[number] = made_move(planner, free, ways, row, column, columns, motion, on)
