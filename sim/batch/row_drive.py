"""A run to the end of its episode in compiled words, all rows of the road, with the draws of its seed.

Guarantee: the ticks of `sim.transition.step`. Arguments: as in `sim.batch.row_motion`; besides them

- `rows_now` (rows, 3; uint64): all movers, changed in place;
- `cells` (movers; int64): the cell of each mover, changed in place;
- `moves` (ticks; uint8), `met` (ticks; int64): what is found of each tick, see `drive_rows`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, FAR
from sim.batch.compiled import followed_board, pedestrians_walk
from sim.batch.row_costs import (
    cheapest_move,
    cost_scratch,
    has_plan,
    no_scratch,
    planned_move,
    put_row,
    put_vehicle,
    safe_words,
)
from sim.batch.row_motion import (
    CAME_LEFT,
    CAME_RIGHT,
    FIELDS,
    LEFT,
    RIGHT,
    STAY,
    WALKERS,
    braked_motion,
    free_moves,
    hopeful_rows,
    roll_rows,
    row_motion,
)
from sim.batch.row_rules import BY_COST, RULES, find_ways, made_move
from sim.compilation import compiled, fraction, word_at

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def drawn_beside(near, bit, cell, key, tick, share):
    """Of the movers beside the vehicle, those that are drawn to react in this tick of the episode."""
    if share == 0.0 or near == _ZERO:
        return _ZERO
    if share == 1.0:
        return near
    draws, drawn = word_at(key, tick), _ZERO
    if near & bit >> _ONE and fraction(word_at(draws, cell - 1)) < share:
        drawn |= bit >> _ONE
    if near & bit << _ONE and fraction(word_at(draws, cell + 1)) < share:
        drawn |= bit << _ONE
    return drawn


@compiled
def own_row_motion(right, left, walkers, holes, fixed, bit, cell, tick, shares, keys, last_bit):
    """The movers of the vehicle's row in a tick: who goes on where it moves, and where it stays.

    Returns also who gives way to it and who brakes for it, as bits of the row.
    """
    near = ((bit & ~_ONE) >> _ONE | (bit & ~last_bit) << _ONE) & (right | left)
    yields = drawn_beside(near, bit, cell, keys[0], tick, shares[0])
    brakes = drawn_beside(near, bit, cell, keys[1], tick, shares[1])
    walking = pedestrians_walk(tick)
    motion = row_motion(right, left, walkers, holes, fixed, yields, bit, walking, last_bit)
    return motion, braked_motion(motion, bit, brakes), yields, brakes


@compiled
def _move_rows(rows_now, after, fixed, holes, row, own, tick, last_bit):
    """The movers of all rows after a tick; in the vehicle's row they go as `own` says."""
    walking = pedestrians_walk(tick)
    for each in range(rows_now.shape[0]):
        walkers = rows_now[each, WALKERS]
        motion = own
        if each != row:
            motion = row_motion(
                rows_now[each, RIGHT],
                rows_now[each, LEFT],
                walkers,
                holes[each],
                fixed[each],
                _ZERO,
                _ZERO,
                walking,
                last_bit,
            )
        after[each, RIGHT], after[each, LEFT] = motion.right, motion.left
        after[each, WALKERS] = followed_board(walkers, motion) if walkers else _ZERO
        after[each, CAME_RIGHT], after[each, CAME_LEFT] = motion.came_right, motion.came_left


@compiled
def _follow(cells, after, columns):
    """Move each mover's cell along with the boards."""
    for each in range(cells.size):
        row, at = cells[each] // columns, np.uint64(cells[each] % columns)
        if after[row, CAME_RIGHT] >> at >> _ONE & _ONE:
            cells[each] += 1
        elif after[row, CAME_LEFT] << _ONE >> at & _ONE:
            cells[each] -= 1


@compiled
def _mover_in(cells, cell):
    """The number of the mover in a cell, −1 where none is."""
    for each in range(cells.size):
        if cells[each] == cell:
            return each
    return -1


@compiled
def _hopeful_from(rows_now, fixed, holes, place, row):
    """The columns from which the goal may be reached, by ticks from now and row, up to the vehicle's row."""
    _, last_bit, episode_tick, max_ticks, _ = place
    limit = max(1, max_ticks + 1 - episode_tick)
    rolled = np.empty((limit + 2, row + 1, FIELDS), np.uint64)
    for each in range(row + 1):
        rolled[0, each, :3] = rows_now[each]
    roll_rows(rolled, 0, limit, row, fixed, holes, episode_tick, last_bit)
    hopeful = np.empty((limit + 1, row + 1), np.uint64)
    hopeful_rows(hopeful, rolled, limit, row + 1, fixed, last_bit)
    return hopeful


@compiled
def drive_rows(rows_now, fixed, holes, place, cell, planner, weights, shares, keys, most, cells, moves, met):
    """Drive until before the tick that ends the episode, or for `most` ticks; the ticks, and the cell then.

    `shares` (2; float64), `keys` (2; uint64): of courtesy and attentiveness. Written are, of each tick, the
    move and, where it is not straight on, the number of the mover that is straight ahead after it (−1: none).
    """
    columns, last_bit, episode_tick, max_ticks, swept = place
    count = rows_now.shape[0]
    ways = np.empty((3, count, columns), np.int16)
    if planner == RULES:
        find_ways(ways, rows_now[:, RIGHT] | rows_now[:, LEFT], fixed, count, columns, last_bit)
    if planner == BY_COST:
        scratch, size = cost_scratch(count, columns, max_ticks, weights, 2 * count)
        safe = safe_words(rows_now[:, RIGHT] | rows_now[:, LEFT], fixed, columns, last_bit)
    else:
        scratch, size = no_scratch()
        safe = fixed
    after = np.empty((count, 5), np.uint64)
    planned = -1  # the tick at which the way was found that is being driven; none: −1
    # Where the goal is out of reach is found out once no way is found: `since` that tick; before that: −1.
    hopeful, since = np.empty((1, 1), np.uint64), -1
    kept = scratch[4].shape[0]
    for ahead in range(most):
        tick = episode_tick + ahead
        row, column = cell // columns, cell % columns
        bit = _ONE << np.uint64(column)
        own = rows_now[row]
        motion, braked, yields, brakes = own_row_motion(
            own[RIGHT],
            own[LEFT],
            own[WALKERS],
            holes[row],
            fixed[row],
            bit,
            cell,
            tick,
            shares,
            keys,
            last_bit,
        )
        _move_rows(rows_now, after, fixed, holes, row, motion, tick, last_bit)
        on = after[row - 1]
        free = free_moves(bit, motion, braked, fixed[row], on, fixed[row - 1], swept, last_bit)
        braking = braked.came_right != motion.came_right or braked.came_left != motion.came_left
        as_planned = planned >= 0 and ahead - planned < kept and not yields and not braking
        if planner == BY_COST and as_planned:
            move = np.int64(planned_move(scratch, ahead - planned, cell, weights, columns))
        elif planner == BY_COST:
            last_row = min(row + max(1, weights[BUFFER]), count - 1)
            for each in range(last_row + 1):
                now = rows_now[each]
                put_row(
                    scratch[0],
                    each,
                    columns,
                    now[RIGHT],
                    now[LEFT],
                    now[WALKERS],
                    fixed[each],
                    holes[each],
                )
            put_vehicle(scratch[0], cell, columns, yields, brakes)
            hopeless = since >= 0 and not hopeful[ahead - since, row] >> np.uint64(column) & _ONE
            limit = max_ticks + 1 - tick
            scratch[5][:] = FAR
            move = np.int64(
                cheapest_move(scratch, size, safe, cell, last_row, tick, limit, swept, weights, hopeless)
            )
            planned = ahead if not braking and has_plan(scratch) else -1
            if since < 0 and not has_plan(scratch):
                now_place = columns, last_bit, tick, max_ticks, swept
                hopeful, since = _hopeful_from(rows_now, fixed, holes, now_place, row), ahead
        else:
            move = made_move(planner, free, ways, row, column, columns, motion, on)
        end = cell
        if move == 1 or move == 3:
            end -= 1
        elif move == 2 or move == 4:
            end += 1
        if move == 0 or move == 3 or move == 4:
            end -= columns
        crashed = move == STAY and not free >> STAY & 1
        if crashed or end < columns or tick + 1 > max_ticks:
            return ahead, cell
        if move == STAY:
            after[row, RIGHT], after[row, LEFT] = braked.right, braked.left
            after[row, CAME_RIGHT], after[row, CAME_LEFT] = braked.came_right, braked.came_left
            walkers = rows_now[row, WALKERS]
            after[row, WALKERS] = followed_board(walkers, braked) if walkers else _ZERO
        _follow(cells, after, columns)
        moves[ahead] = move
        met[ahead] = -1
        if move != 0 and (after[row - 1, RIGHT] | after[row - 1, LEFT]) & bit:
            met[ahead] = _mover_in(cells, cell - columns)
        rows_now[:] = after[:, :3]
        cell = end
    return most, cell
