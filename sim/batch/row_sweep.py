"""Cost to the destination row by row, in compiled words: what one row costs, given the row before it.

Movers keep to their rows, so each row is rolled out by itself. What a row costs hangs on its own movers,
on those of the rows next to it, and on the costs of the row before it (nearer to the destination). Charges
and steps are those of `sim.batch.backward_dp`, which sweeps tick by tick.

Array arguments, besides those of `sim.batch.one_decision` (*known* rows: those up to the vehicle's, and as
many behind it as movers are kept clear of; *slots*: twice as many, of which the first half holds a base and
the second half what is otherwise, `sim.batch.changed_rows`):

- `slots` (2, known; int64): the slot of each row, for what is in it and for its costs;
- `lines` (slots, ticks, 3; uint64): a row's movers after each tick, see `STANDING`;
- `fixed` (slots; uint64): what never moves in a row;
- `entering` (slots, ticks + 1, columns + 2; int32): what entering each cell with a tick costs, and the way on
  from there; the outer columns are `FAR`;
- `getting` (known, ticks, columns + 2; int32): of the base, the least cost of getting to each cell with a
  tick, without what is charged for being there.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, DIAGONAL, FAR, NEAR_FIXED, NEAR_MOVER, SIDEWAYS, TICK, WAITING
from sim.batch.compiled import beside, brake, cut_off, followed_board, move_movers, pedestrians_walk
from sim.batch.reachability import (
    ALL_FIXED,
    BRAKES,
    NOW_LEFT,
    NOW_RIGHT,
    NOW_WALKERS,
    RESTING_IN_HOLES,
    STAY,
    YIELDS,
)
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)

STANDING, FROM_LEFT, FROM_RIGHT = range(3)
"""Of a row after a tick: the cells of its movers, and those entered by a step to the right, to the left."""


@compiled
def charged_rows(weights):
    """Rows to either side of a thing in which it is charged for."""
    return max(weights[BUFFER], 1 if weights[NEAR_FIXED] > 0 else 0)


@compiled
def roll_row(line, fixed, slot, seen, row, ticks, episode_tick, columns, vehicle, stands):
    """Roll out the movers of one row; whether one brakes in the first tick for a vehicle that stays.

    `vehicle`: the vehicle's column, as a bit, in its own row; else none.
    """
    rows_per_word = 64 // columns
    w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
    right_edge = _ONE << np.uint64(columns - 1)
    mask = (right_edge << _ONE) - _ONE
    right, left = seen[NOW_RIGHT, w] >> shift & mask, seen[NOW_LEFT, w] >> shift & mask
    walkers, held = seen[NOW_WALKERS, w] >> shift & mask, seen[RESTING_IN_HOLES, w] >> shift & mask
    yielding, attentive = seen[YIELDS, w] >> shift & mask, seen[BRAKES, w] >> shift & mask
    stuck = seen[ALL_FIXED, w] >> shift & mask
    fixed[slot] = stuck
    brakes = False
    for ahead in range(ticks):
        resting = held
        if walkers and not pedestrians_walk(episode_tick + ahead):
            resting |= walkers
        there = vehicle if ahead == 0 else _ZERO
        motion = move_movers(right, left, resting, stuck, yielding, there, _ONE, right_edge)
        if there:
            braked = brake(motion, there, attentive)
            brakes = braked.came_right != motion.came_right or braked.came_left != motion.came_left
            if stands:
                motion = braked
        if walkers:
            walkers = followed_board(walkers, motion)
        right, left = motion.right, motion.left
        line[ahead, STANDING] = right | left
        line[ahead, FROM_LEFT] = motion.came_right
        line[ahead, FROM_RIGHT] = motion.came_left
    return brakes


@compiled
def _near_fixed(fixed, slots, row, columns):
    """The cells of a row with something fixed in or around them."""
    around = fixed[slots[0, row]] | fixed[slots[0, row + 1]]
    if row > 0:
        around |= fixed[slots[0, row - 1]]
    return beside(around, _ONE, _ONE << np.uint64(columns - 1))


@compiled
def _near_movers(lines, slots, row, ahead, distance, columns):
    """The cells of a row within so many cells of a mover after a tick."""
    movers = lines[slots[0, row], ahead, STANDING]
    for beyond in range(1, distance + 1):
        movers |= lines[slots[0, row + beyond], ahead, STANDING]
        if row >= beyond:
            movers |= lines[slots[0, row - beyond], ahead, STANDING]
    for _ in range(distance):
        movers = beside(movers, _ONE, _ONE << np.uint64(columns - 1))
    return movers


@compiled
def _charge(costs, slot, place, ahead, lines, slots, row, taken, near_fixed, weights, columns):
    """Add what is charged for being in each cell of a row after a tick; `FAR` where it is taken.

    `costs` (slots, places, columns + 2), of which one slot and place are meant.
    """
    by_fixed, by_mover = np.int32(weights[NEAR_FIXED]), np.int32(weights[NEAR_MOVER])
    near = _near_movers(lines, slots, row, ahead, 1, columns) if weights[BUFFER] > 0 else _ZERO
    for column in range(columns):
        at = np.uint64(column)
        cost = costs[slot, place, column + 1]
        cost += by_fixed if near_fixed >> at & _ONE else np.int32(0)
        cost += by_mover if near >> at & _ONE else np.int32(0)
        costs[slot, place, column + 1] = FAR if taken >> at & _ONE else min(cost, FAR)
    for distance in range(2, weights[BUFFER] + 1):
        near = _near_movers(lines, slots, row, ahead, distance, columns)
        for column in range(columns):
            cost = costs[slot, place, column + 1]
            cost += by_mover if near >> np.uint64(column) & _ONE else np.int32(0)
            costs[slot, place, column + 1] = min(cost, FAR)


@compiled
def sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept):
    """Write what entering the cells of a row costs, in the ticks in which the vehicle can be on time there.

    The row before it has been swept.
    """
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    before = max(row - 1, 0)
    line, into, stuck = slots[0, row], slots[1, row], fixed[slots[0, row]]
    line_on, on = slots[0, before], slots[1, before]
    if row > 0:
        for column in range(1, columns + 1):
            entering[into, horizon - row, column] = FAR  # too late to arrive
    near_fixed = _near_fixed(fixed, slots, row, columns)
    for ahead in range(horizon - row - 1, max(0, start_row - row - 1) - 1, -1):
        if row == 0:
            for column in range(1, columns + 1):
                entering[into, ahead, column] = np.int32(0)
        else:
            then = ahead + 1
            from_left, from_right = lines[line, then, FROM_LEFT], lines[line, then, FROM_RIGHT]
            cut_left, cut_right = cut_off(
                lines[line_on, then, FROM_LEFT] & swept,
                lines[line_on, then, FROM_RIGHT] & swept,
                from_left & swept,
                from_right & swept,
            )
            for column in range(1, columns + 1):
                at = np.uint64(column - 1)
                to_left = FAR if from_left >> at & _ONE else entering[into, then, column - 1]
                to_right = FAR if from_right >> at & _ONE else entering[into, then, column + 1]
                best = min(entering[on, then, column] + tick, min(to_left, to_right) + side)
                to_left = FAR if cut_left >> at & _ONE else entering[on, then, column - 1]
                to_right = FAR if cut_right >> at & _ONE else entering[on, then, column + 1]
                best = min(best, min(to_left, to_right) + slant)
                entering[into, ahead, column] = min(best, entering[into, then, column] + wait)
        taken = lines[line, ahead, STANDING] | stuck
        _charge(entering, into, ahead, ahead, lines, slots, row, taken, near_fixed, weights, columns)


@compiled
def write_row_totals(totals, entering, lines, slots, cell, weights, columns, swept):
    """Write the totals of the six moves now."""
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    row, column, at = cell // columns, cell % columns + 1, np.uint64(cell % columns)
    here, on = entering[slots[1, row], 0], entering[slots[1, row - 1], 0]
    line, line_on = lines[slots[0, row], 0], lines[slots[0, row - 1], 0]
    from_left, from_right = line[FROM_LEFT], line[FROM_RIGHT]
    cut_left, cut_right = cut_off(
        line_on[FROM_LEFT] & swept, line_on[FROM_RIGHT] & swept, from_left & swept, from_right & swept
    )
    totals[0] = on[column] + tick
    totals[1] = FAR if from_left >> at & _ONE else here[column - 1] + side
    totals[2] = FAR if from_right >> at & _ONE else here[column + 1] + side
    totals[3] = FAR if cut_left >> at & _ONE else on[column - 1] + slant
    totals[4] = FAR if cut_right >> at & _ONE else on[column + 1] + slant
    totals[STAY] = here[column] + wait


@compiled
def sweep_forward(getting, lines, fixed, slots, cell, horizon, weights, columns, swept, stands):
    """Write the least cost of getting to every cell of the base with each tick.

    With `stands` the vehicle stays in the first one.
    """
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    start_row = cell // columns
    been = np.full((1, start_row + 2, columns + 2), FAR, np.int32)
    been[0, start_row, cell % columns + 1] = 0
    for ahead in range(horizon):
        first = max(0, start_row - ahead - 1)
        for row in range(first, start_row + 1):
            line, line_behind = lines[row, ahead], lines[row + 1, ahead]
            from_left, from_right = line[FROM_LEFT], line[FROM_RIGHT]
            cut_left, cut_right = cut_off(
                from_left & swept,
                from_right & swept,
                line_behind[FROM_LEFT] & swept,
                line_behind[FROM_RIGHT] & swept,
            )
            there, behind, into = been[0, row], been[0, row + 1], getting[row, ahead]
            for column in range(1, columns + 1):
                if stands and ahead == 0:
                    into[column] = min(there[column] + wait, FAR)
                    continue
                best = min(behind[column] + tick, there[column] + wait)
                if column < columns:  # from the cell on the right
                    start = np.uint64(column)
                    best = min(best, FAR if from_left >> start & _ONE else there[column + 1] + side)
                    best = min(best, FAR if cut_left >> start & _ONE else behind[column + 1] + slant)
                if column > 1:
                    start = np.uint64(column - 2)
                    best = min(best, FAR if from_right >> start & _ONE else there[column - 1] + side)
                    best = min(best, FAR if cut_right >> start & _ONE else behind[column - 1] + slant)
                into[column] = min(best, FAR)
        for row in range(first, start_row + 1):
            been[0, row, 1 : columns + 1] = getting[row, ahead, 1 : columns + 1]
            near_fixed = _near_fixed(fixed, slots, row, columns)
            taken = lines[row, ahead, STANDING] | fixed[row]
            _charge(been, 0, row, ahead, lines, slots, row, taken, near_fixed, weights, columns)
