"""The rule planner of a lane by what is believed (`sim.plan.priority`)."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import cut_off, free_steps, move_movers, pedestrians_walk
from sim.batch.drawn_reactions import drawn_beside
from sim.batch.layout import (
    CELL,
    COLUMN_BIT,
    COURTESY,
    COURTESY_KEY,
    EPISODE_TICK,
    FIXED,
    HOLES,
    LANES,
    LEFT,
    PLANES,
    RIGHT,
    SHIFT,
    SWEPT,
    WALKERS,
    WORD,
)
from sim.compilation import on_given_arrays
from sim.types import MOVES, Move

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_FORWARD, _LEFT, _RIGHT, _FORWARD_LEFT, _FORWARD_RIGHT, _STAY = (MOVES.index(move) for move in Move)


@on_given_arrays
def motion_of(block, at, tick, yielding, vehicle, left_edge, right_edge):
    """A word of what is believed one tick on; `at`: where its planes begin."""
    right, left = block[at + RIGHT * LANES], block[at + LEFT * LANES]
    resting = (right | left) & block[at + HOLES * LANES]
    if not pedestrians_walk(tick):
        resting |= block[at + WALKERS * LANES]
    fixed = block[at + FIXED * LANES]
    return move_movers(right, left, resting, fixed, yielding, vehicle, left_edge, right_edge)


@on_given_arrays
def rule_move(block, believed, v, i, columns, shares, left_edge, right_edge):
    """The move of lane `i`: `block` holds what is there, `believed` what is believed, `v` the lane planes."""
    shift, word = v[SHIFT * LANES + i], np.int64(v[WORD * LANES + i])
    bit, cell = v[COLUMN_BIT * LANES + i], np.int64(v[CELL * LANES + i])
    tick = np.int64(v[EPISODE_TICK * LANES + i])
    carried = shift == _ZERO
    word_ahead = word - 1 if carried else word
    shift_ahead = np.uint64((64 // columns - 1) * columns) if carried else shift - np.uint64(columns)
    last_bit = _ONE << np.uint64(columns - 1)
    own_at, on_at = word * PLANES * LANES + i, word_ahead * PLANES * LANES + i
    # Who gives way is drawn of those that are there (`Percept.yielding`). Who brakes has no part: to stay
    # comes last whatever comes of it.
    there = (block[own_at + RIGHT * LANES] | block[own_at + LEFT * LANES]) >> shift
    key = v[COURTESY_KEY * LANES + i]
    yields = drawn_beside(key, tick, cell, bit, last_bit, shares[COURTESY]) & there
    seen = (believed[own_at + RIGHT * LANES] | believed[own_at + LEFT * LANES]) >> shift
    motion = motion_of(believed, own_at, tick, (yields & seen) << shift, bit << shift, left_edge, right_edge)
    on = motion
    if carried:
        on = motion_of(believed, on_at, tick, _ZERO, _ZERO, left_edge, right_edge)
    came_right, came_left = motion.came_right >> shift, motion.came_left >> shift
    swept = v[SWEPT * LANES + i]
    cut_left, cut_right = cut_off(
        on.came_right >> shift_ahead & swept,
        on.came_left >> shift_ahead & swept,
        came_right & swept,
        came_left & swept,
    )
    blocked = (motion.right | motion.left | believed[own_at + FIXED * LANES]) >> shift
    own = free_steps(bit, _ZERO, blocked, came_right, came_left, _ZERO, _ZERO, _ONE, last_bit)
    blocked = (on.right | on.left | believed[on_at + FIXED * LANES]) >> shift_ahead
    ahead = free_steps(_ZERO, bit, blocked, _ZERO, _ZERO, cut_left, cut_right, _ONE, last_bit)
    if ahead.forward:
        return _FORWARD
    if own.left:
        return _LEFT
    if own.right:
        return _RIGHT
    if ahead.forward_left:
        return _FORWARD_LEFT
    return _FORWARD_RIGHT if ahead.forward_right else _STAY
