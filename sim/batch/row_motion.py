"""One tick around one vehicle, row by row, in compiled words: a word holds a row.

Rows do not interact, and a mover reacts only to a vehicle in its own row. A vehicle never goes back, so the
rows ahead of it go on as the roll-out without a vehicle has them until it enters them. A moment of a future
is thus the vehicle's cell and what its own row holds; everything else is rolled out once for all futures.

Array arguments of all kernels that work by rows (rows: those of the road, destination first):

- `fixed`, `holes` (rows; uint64): the cells of a row that are taken for good, and those that hold a mover;
- `rolled` (ticks, rows, 5; uint64): movers after so many ticks where no vehicle is met, see `RIGHT`;
- `row_words` (3; uint64): movers of one row, by `RIGHT`, `LEFT` and `WALKERS`.

Numbers: `ahead`, `limit` in ticks from now; `episode_tick` the tick of the episode that begins now; `bit` is
the vehicle's column (uint64), `last_bit` the last column; `yields` and `brakes` are the columns of movers
that react in the tick; `swept` is all ones where bodies collide by what they sweep, else 0 (uint64).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import brake, cut_off, followed_board, free_steps, move_movers, pedestrians_walk
from sim.compilation import compiled

RIGHT, LEFT, WALKERS, CAME_RIGHT, CAME_LEFT = range(5)
FIELDS: Final = 5
STAY: Final = 5

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def row_motion(right, left, walkers, holes, fixed, yields, bit, walking, last_bit):
    """Where the movers of a row are after a tick, unless one brakes."""
    resting = (right | left) & holes
    if not walking:
        resting |= walkers
    return move_movers(right, left, resting, fixed, yields, bit, _ONE, last_bit)


@compiled
def roll_rows(rolled, start, stop, count, fixed, holes, episode_tick, last_bit):
    """Roll out rows 0 to before `count` from `start` to `stop` ticks ahead, without a vehicle."""
    for ahead in range(start, stop):
        walking = pedestrians_walk(episode_tick + ahead)
        for row in range(count):
            right, left, walkers = (
                rolled[ahead, row, RIGHT],
                rolled[ahead, row, LEFT],
                rolled[ahead, row, WALKERS],
            )
            after = rolled[ahead + 1, row]
            motion = row_motion(right, left, walkers, holes[row], fixed[row], _ZERO, _ZERO, walking, last_bit)
            after[RIGHT], after[LEFT] = motion.right, motion.left
            after[WALKERS] = followed_board(walkers, motion) if walkers else _ZERO
            after[CAME_RIGHT], after[CAME_LEFT] = motion.came_right, motion.came_left


@compiled
def beside_row(columns_taken, last_bit):
    """Columns with their neighbours."""
    return columns_taken | (columns_taken & ~_ONE) >> _ONE | (columns_taken & ~last_bit) << _ONE


@compiled
def braked_motion(motion, bit, brakes):
    """The motion of the vehicle's row where the vehicle stays."""
    return brake(motion, bit, brakes) if (motion.right | motion.left) & bit else motion


@compiled
def free_moves(bit, motion, braked, fixed, ahead, fixed_ahead, swept, last_bit):
    """The moves that meet nothing, bit by bit in the order of `MOVES`; `ahead`: the next row's words."""
    taken = ahead[RIGHT] | ahead[LEFT] | fixed_ahead
    cut_left, cut_right = cut_off(
        ahead[CAME_RIGHT] & swept,
        ahead[CAME_LEFT] & swept,
        motion.came_right & swept,
        motion.came_left & swept,
    )
    own = free_steps(
        bit,
        _ZERO,
        motion.right | motion.left | fixed,
        motion.came_right,
        motion.came_left,
        _ZERO,
        _ZERO,
        _ONE,
        last_bit,
    )
    on = free_steps(_ZERO, bit, taken, _ZERO, _ZERO, cut_left, cut_right, _ONE, last_bit)
    stays = bit & ~(braked.right | braked.left | fixed)
    return (
        (1 if on.forward else 0)
        | (2 if own.left else 0)
        | (4 if own.right else 0)
        | (8 if on.forward_left else 0)
        | (16 if on.forward_right else 0)
        | (32 if stays else 0)
    )


@compiled
def hopeful_rows(hopeful, rolled, limit, count, fixed, last_bit):
    """Write the columns from which the goal may still be reached (shape: limit + 1, count).

    As `sim.search.dead_ends` has it, for rows 0 to before `count`.
    """
    whole = (last_bit - _ONE) | last_bit
    for row in range(count):
        hopeful[limit, row] = _ZERO
    hopeful[limit, 0] = whole & ~fixed[0]
    for ahead in range(limit - 1, -1, -1):
        hopeful[ahead, 0] = whole & ~fixed[0]
        for row in range(1, count):
            on = hopeful[ahead + 1, row - 1]
            on &= ~(rolled[ahead + 1, row - 1, RIGHT] | rolled[ahead + 1, row - 1, LEFT])
            there = beside_row(hopeful[ahead + 1, row], last_bit) | beside_row(on, last_bit)
            hopeful[ahead, row] = there & ~fixed[row]
