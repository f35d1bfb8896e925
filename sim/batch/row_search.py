"""The least ticks to the goal where movers react to the vehicle, in compiled words, with every draw known.

Guarantee: `sim.search.reactive.ReactiveSearch.least_ticks`, and as many states looked at. Arguments: as in
`sim.batch.row_motion` and `sim.batch.row_drive`; besides them

- `layer`, `after` (states, 4; uint64) with `numbers` (states; int64): what the vehicle's row holds and the
  columns it may be in then, and the number of the row; `after` is the layer that follows;
- `slots` (a power of two; int32): the states of `after` by what they hold, −1 where there is none.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import first_bit, followed_board
from sim.batch.row_drive import own_row_motion
from sim.batch.row_motion import (
    FIELDS,
    LEFT,
    RIGHT,
    STAY,
    WALKERS,
    free_moves,
    hopeful_rows,
    roll_rows,
)
from sim.compilation import compiled, word_at

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_COLUMNS: Final = 3
"""Of a state, after the words of the row: the columns of the vehicle."""
_SPARE: Final = (1, 5, 20, -1)
"""`sim.search.reactive.SPARE_TICKS`, then the whole limit."""
NONE: Final = -1
IMPATIENT: Final = -2


@compiled
def _put(after, numbers, slots, count, number, right, left, walkers, columns):
    """Add columns to a state of the layer that follows; how many states it has."""
    mask = np.uint64(slots.size - 1)
    at = (word_at(right ^ left << _ONE, number) ^ walkers) & mask
    while slots[at] >= 0:
        same = after[slots[at]]
        alike = numbers[slots[at]] == number and same[RIGHT] == right and same[LEFT] == left
        if alike and same[WALKERS] == walkers:
            same[_COLUMNS] |= columns
            return count
        at = (at + _ONE) & mask
    slots[at] = count
    after[count, RIGHT], after[count, LEFT], after[count, WALKERS] = right, left, walkers
    after[count, _COLUMNS], numbers[count] = columns, number
    return count + 1


@compiled
def _step(state, number, bit, ahead, road, rolled, shares, keys, after, numbers, slots, count):
    """Add where every move of one vehicle leads that meets nothing; how many states there are then."""
    fixed, holes, columns, last_bit, episode_tick, swept = road
    walkers = state[WALKERS]
    motion, braked, _, _ = own_row_motion(
        state[RIGHT],
        state[LEFT],
        walkers,
        holes[number],
        fixed[number],
        bit,
        number * columns + first_bit(bit),
        episode_tick + ahead,
        shares,
        keys,
        last_bit,
    )
    on = rolled[ahead + 1, number - 1]
    free = free_moves(bit, motion, braked, fixed[number], on, fixed[number - 1], swept, last_bit)
    beside = (bit >> _ONE if free & 2 else _ZERO) | (bit << _ONE if free & 4 else _ZERO)
    if beside:
        walked = followed_board(walkers, motion) if walkers else _ZERO
        count = _put(after, numbers, slots, count, number, motion.right, motion.left, walked, beside)
    if free >> STAY & 1:
        walked = followed_board(walkers, braked) if walkers else _ZERO
        count = _put(after, numbers, slots, count, number, braked.right, braked.left, walked, bit)
    entered = bit if free & 1 else _ZERO
    entered |= (bit >> _ONE if free & 8 else _ZERO) | (bit << _ONE if free & 16 else _ZERO)
    if entered:
        count = _put(after, numbers, slots, count, number - 1, on[RIGHT], on[LEFT], on[WALKERS], entered)
    return count


@compiled
def _within(first, cell, limit, patience, road, rolled, hopeful, shares, keys):
    """Ticks of the quickest way within so many; `NONE`, or `IMPATIENT` where too many states were met."""
    columns = road[2]
    row = cell // columns
    if not hopeful[0, row] >> np.uint64(cell % columns) & _ONE:
        return NONE
    room = 6 * patience + 64
    size = 1024
    while size < 2 * room:
        size *= 2
    layer, after = np.empty((room, 4), np.uint64), np.empty((room, 4), np.uint64)
    numbers, numbers_after = np.empty(room, np.int64), np.empty(room, np.int64)
    slots = np.full(size, -1, np.int32)
    layer[0, :3] = first
    layer[0, _COLUMNS], numbers[0], length = _ONE << np.uint64(cell % columns), row, 1
    looked_at = 0
    for ahead in range(limit):
        for each in range(length):
            board = layer[each, _COLUMNS]
            while board:
                looked_at += 1
                board &= board - _ONE
        if looked_at > patience:
            return IMPATIENT
        slots[:] = -1
        count = 0
        for each in range(length):
            board = layer[each, _COLUMNS]
            while board:
                bit = board & (~board + _ONE)
                board ^= bit
                count = _step(
                    layer[each],
                    numbers[each],
                    bit,
                    ahead,
                    road,
                    rolled,
                    shares,
                    keys,
                    after,
                    numbers_after,
                    slots,
                    count,
                )
        length = 0
        for each in range(count):
            number = numbers_after[each]
            kept = after[each, _COLUMNS] & hopeful[ahead + 1, number]
            if not kept:
                continue
            if number == 0:
                return ahead + 1
            layer[length, :3] = after[each, :3]
            layer[length, _COLUMNS], numbers[length] = kept, number
            length += 1
        if not length:
            return NONE
    return NONE


@compiled
def least_ticks_among(rows_now, fixed, holes, place, cell, limit, patience, shares, keys):
    """Ticks of the quickest way to row 0 within so many; `NONE` or `IMPATIENT`, as `_within` has it.

    `rows_now` (rows, 3; uint64): the movers of rows 0 to the vehicle's. `patience`: states to look at.
    """
    columns, last_bit, episode_tick, _, swept = place
    row = cell // columns
    if row == 0:
        return 0
    rolled = np.empty((limit + 2, row + 1, FIELDS), np.uint64)
    for each in range(row + 1):
        rolled[0, each, :3] = rows_now[each]
    hopeful = np.empty((limit + 1, row + 1), np.uint64)
    road = fixed, holes, columns, last_bit, episode_tick, swept
    reached = 0
    for spare in _SPARE:
        within = row + spare if spare >= 0 else limit
        if spare >= 0 and within >= limit:
            continue
        if within > reached:
            roll_rows(rolled, reached, within, row, fixed, holes, episode_tick, last_bit)
            reached = within
        hopeful_rows(hopeful, rolled, within, row + 1, fixed, last_bit)
        found = _within(rows_now[row], cell, within, patience, road, rolled, hopeful, shares, keys)
        if found != NONE:
            return found
    return NONE
