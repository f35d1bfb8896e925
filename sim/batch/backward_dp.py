"""The least cost to the goal, in compiled words: what `astar` and `dijkstra` decide, for thousands of worlds.

Structure: the exact search (`sim.batch.reachability`) gives one way; its cost bounds how long a cheaper way
can be, so that a backward sweep over (tick, row, column) within that horizon is exact (dynamic programming in
topological order; every step goes one tick on). Rows the ego cannot have reached yet are left out.
The charges are those of `sim.search.costs`, in whole numbers. Guarantees and simplifications as there.

Array arguments, besides those of `sim.batch.reachability` (words: those of a board; costs in charges):

- `weights` (7; int64), a lane's row of `charges` (lanes, 7; int64): the charges of one step, see `TICK`;
- `near` (2 + buffer, words; uint64): boards of the cells beside fixed hazards, of movers, and of the cells
  within 1, 2, ... cells of a mover;
- `value` (rows, columns + 2; int32): the cost to go from a cell; the outer columns are `FAR`, the edges of
  the road; `entering` (depth, rows, columns + 2; int32): that of entering it, of as many ticks as are kept;
- `totals` (6; int32): the cost of each move now with the cheapest way on, in the order of `MOVES`;
- `moves` (lanes; uint8), `costs` (lanes; int64): the answers.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.compiled import beside, max_ticks, steps_left
from sim.batch.layout import CELL, EPISODE_TICK, LANES, OUTCOME, SWEPT
from sim.batch.reachability import (
    ALL_FIXED,
    BLOCKED,
    BOARDS,
    CAME_LEFT,
    CAME_RIGHT,
    FIELDS,
    MOVERS,
    STAY,
    crossings,
    keep_shortest,
    longest_survival,
    one_row_back,
    one_row_on,
    prepare,
    roll,
    search,
    someone_brakes,
    step_from,
)
from sim.compilation import compiled

TICK, SIDEWAYS, DIAGONAL, WAITING, NEAR_FIXED, NEAR_MOVER, BUFFER = range(7)
"""Columns of a batch's table of charges (int64), as in `sim.search.costs.Weights`."""

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
FAR: Final = np.int32(1 << 29)
"""More than any way costs; two of them still fit."""


@compiled
def make_scratch(words, rows, columns, most_ticks, buffer, depth):
    """Room for decisions by cost of up to so many ticks, as `totals_of_way` takes it.

    `words`: those of a board, which are fewer than those of the road where only what is near matters.
    `depth`: ticks of which the costs are kept: 1, or all of them (`most_ticks`) for `write_totals`.
    """
    return (
        np.empty((BOARDS, words), np.uint64),
        np.empty((most_ticks + 3, FIELDS, words), np.uint64),
        np.empty((2 + buffer, words), np.uint64),
        np.full((rows, columns + 2), FAR, np.int32),
        np.full((depth, rows, columns + 2), FAR, np.int32),
        np.full(6, FAR, np.int32),
    )


@compiled
def cheaper(scratch, stands, least, move):
    """The lesser of a cost and the totals that were written, and its move; `stands`: only of staying."""
    totals = scratch[5]
    if stands:
        totals[:STAY] = FAR
    if totals.min() < least:
        move = np.argmin(totals)
        least = totals[move]
    return least, move


@compiled
def around(board, wider, last, columns, left_edge, right_edge):
    """A board (words 0 to `last`) with the eight neighbours of its cells."""
    for w in range(last + 1):
        tall = board[w] | one_row_on(board, w, last, columns) | one_row_back(board, w, columns)
        wider[w] = beside(tall, left_edge, right_edge)


@compiled
def _charges(into, near, layers, ahead, last, weights, first_row, last_row, columns, left_edge, right_edge):
    """What entering each cell after the step costs beside the move (shape of `into`: rows, columns + 2)."""
    rows_per_word = 64 // columns
    buffer = weights[BUFFER]
    for w in range(last + 1):
        near[1, w] = layers[ahead, MOVERS, w]
    for distance in range(buffer):
        around(near[1 + distance], near[2 + distance], last, columns, left_edge, right_edge)
    near_fixed, near_mover = np.int32(weights[NEAR_FIXED]), np.int32(weights[NEAR_MOVER])
    for row in range(first_row, last_row + 1):
        w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
        line = into[row]
        fixed, blocked = near[0, w] >> shift, layers[ahead, BLOCKED, w] >> shift
        for column in range(columns):
            at = np.uint64(column)
            charge = near_fixed if fixed >> at & _ONE else np.int32(0)
            line[column + 1] = FAR if blocked >> at & _ONE else charge
        for distance in range(buffer):
            close = near[2 + distance, w] >> shift
            for column in range(columns):
                line[column + 1] += near_mover if close >> np.uint64(column) & _ONE else np.int32(0)


@compiled
def cost_of_way(layers, near, ticks, cell, last, weights, columns, left_edge, right_edge):
    """What the exact search's way costs (an upper bound for the least)."""
    rows_per_word = 64 // columns
    total = 0
    for ahead in range(ticks):
        move, cell = step_from(layers, ahead, cell, columns)
        total += weights[TICK]
        total += weights[SIDEWAYS] if move == 1 or move == 2 else 0
        total += weights[DIAGONAL] if move == 3 or move == 4 else 0
        total += weights[WAITING] if move == STAY else 0
        row = cell // columns
        w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns + cell % columns)
        total += weights[NEAR_FIXED] if near[0, w] >> shift & _ONE else 0
        for word in range(last + 1):
            near[1, word] = layers[ahead, MOVERS, word]
        for distance in range(weights[BUFFER]):
            around(near[1 + distance], near[2 + distance], last, columns, left_edge, right_edge)
            total += weights[NEAR_MOVER] if near[2 + distance, w] >> shift & _ONE else 0
    return total


@compiled
def sweep(scratch, horizon, cell, last, weights, size):
    """Cost-to-go backwards from `horizon` ticks ahead; writes the totals of the six moves now.

    `scratch` and `size`: as for `totals_of_way`.
    """
    _, layers, near, value, kept, _ = scratch
    columns, left_edge, right_edge = size
    rows_per_word = 64 // columns
    start_row = cell // columns
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    value[: start_row + 1] = FAR
    value[0, 1 : columns + 1] = 0
    for ahead in range(horizon - 1, -1, -1):
        first = max(0, start_row - ahead - 1)
        # From rows further back the goal is not reached within the horizon: there it costs `FAR`.
        furthest = min(start_row, horizon - ahead - 1)
        entering = kept[ahead % kept.shape[0]]
        _charges(
            entering, near, layers, ahead, last, weights, first, furthest, columns, left_edge, right_edge
        )
        if furthest < start_row:
            entering[furthest + 1, 1 : columns + 1] = FAR
        for row in range(first, furthest + 1):
            for column in range(1, columns + 1):
                entering[row, column] = min(entering[row, column] + value[row, column], FAR)
        if ahead == 0:
            break
        for row in range(max(1, start_row - ahead), min(start_row, furthest + 1) + 1):
            w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
            met_left = layers[ahead, CAME_RIGHT, w] >> shift
            met_right = layers[ahead, CAME_LEFT, w] >> shift
            cut_left, cut_right = crossings(layers, ahead, row, columns)
            here, on, into = entering[row], entering[row - 1], value[row]
            for column in range(1, columns + 1):
                at = np.uint64(column - 1)
                to_left = FAR if met_left >> at & _ONE else here[column - 1]
                to_right = FAR if met_right >> at & _ONE else here[column + 1]
                best = min(on[column] + tick, min(to_left, to_right) + side)
                to_left = FAR if cut_left >> at & _ONE else on[column - 1]
                to_right = FAR if cut_right >> at & _ONE else on[column + 1]
                best = min(best, min(to_left, to_right) + slant)
                into[column] = min(min(best, here[column] + wait), FAR)
    write_totals(scratch, 0, cell, weights, columns)


@compiled
def write_totals(scratch, ahead, cell, weights, columns):
    """Write the totals of the six moves from a cell, so many ticks after those of the sweep.

    Later than at once of a way that the sweep has found only, and where its costs are kept (`make_scratch`).
    """
    _, layers, _, _, kept, totals = scratch
    rows_per_word = 64 // columns
    row, start_column = cell // columns, cell % columns
    tick, side = np.int32(weights[TICK]), np.int32(weights[TICK] + weights[SIDEWAYS])
    slant, wait = np.int32(weights[TICK] + weights[DIAGONAL]), np.int32(weights[TICK] + weights[WAITING])
    entering = kept[ahead % kept.shape[0]]
    w = row // rows_per_word
    at = np.uint64(row % rows_per_word * columns + start_column)
    cut_left, cut_right = crossings(layers, ahead, row, columns)
    aslant = np.uint64(start_column)
    here, on, column = entering[row], entering[row - 1], start_column + 1
    totals[0] = on[column] + tick
    totals[1] = FAR if layers[ahead, CAME_RIGHT, w] >> at & _ONE else here[column - 1] + side
    totals[2] = FAR if layers[ahead, CAME_LEFT, w] >> at & _ONE else here[column + 1] + side
    totals[3] = FAR if cut_left >> aslant & _ONE else on[column - 1] + slant
    totals[4] = FAR if cut_right >> aslant & _ONE else on[column + 1] + slant
    totals[5] = here[column] + wait


@compiled
def totals_of_way(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept):
    """Write the totals of the six moves now, of a search that has met the goal after `ticks`.

    `scratch`: (now, layers, near, value, entering, totals); `size`: (columns, left_edge, right_edge).
    """
    now, layers, near = scratch[0], scratch[1], scratch[2]
    columns, left_edge, right_edge = size
    keep_shortest(layers, ticks, cell // columns, last, columns, left_edge, right_edge)
    around(now[ALL_FIXED], near[0], last, columns, left_edge, right_edge)
    bound = cost_of_way(layers, near, ticks, cell, last, weights, columns, left_edge, right_edge)
    horizon = min(bound // weights[TICK], limit)
    for ahead in range(rolled, horizon):
        roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, False)
    sweep(scratch, horizon, cell, last, weights, size)


@compiled
def weighted_moves(state, lanes, shares, charges, columns, rows, left_edge, right_edge, count, moves, costs):
    """For every lane the move of least cost to the goal and that cost (−1: no way)."""
    words = -(-rows // (64 // columns))
    scratch = make_scratch(words, rows, columns, max_ticks(rows), charges[:, BUFFER].max(), 1)
    now, layers = scratch[0], scratch[1]
    size = columns, left_edge, right_edge
    for lane in range(count):
        block, inner = state[lane // LANES], lane % LANES
        lane_block = lanes[lane // LANES]
        moves[lane], costs[lane] = STAY, 0
        if lane_block[OUTCOME * LANES + inner]:
            continue
        weights = charges[lane]
        behind = max(1, weights[BUFFER])
        last = prepare(now, block, lane_block, inner, columns, rows, shares[lane], behind)
        episode_tick = np.int64(lane_block[EPISODE_TICK * LANES + inner])
        limit = steps_left(rows, episode_tick)
        swept = lane_block[SWEPT * LANES + inner]
        cell = np.int64(lane_block[CELL * LANES + inner])
        row = cell // columns
        least, lasted = FAR, 0
        move = np.intp(STAY)
        # Once for every move; where a mover brakes for a vehicle that stays, once more for staying.
        for stands in (False, True):
            if stands:
                if not someone_brakes(now, layers, last):
                    break
                prepare(now, block, lane_block, inner, columns, rows, shares[lane], behind)
            ticks, rolled, kept_clear = search(
                now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
            )
            if ticks >= 0:
                totals_of_way(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept)
                least, move = cheaper(scratch, stands, least, move)
            elif least == FAR and not stands:
                move, lasted = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)
            elif least == FAR and kept_clear > lasted:
                move = np.intp(STAY)
        moves[lane] = move
        costs[lane] = least if least < FAR else -1
