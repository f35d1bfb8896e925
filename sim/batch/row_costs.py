"""The decisions of `astar`, `dijkstra` and `bfs` for the kernels that work by rows, in compiled words.

Structure: rows are put together into words, and the sweep of `sim.batch.backward_dp` tells the cheapest move.
Where it is known that no way leads to the goal, nothing is searched for: that move is made after which one
keeps clear longest, and a cell that no mover comes to keeps clear for ever. Guarantee: the moves of
`sim.batch.one_decision`. Array arguments, besides those of `sim.batch.row_motion`:

- `scratch`: as in `sim.batch.backward_dp`; `weights` (7; int64): the charges, `TICKS_ALONE` for `bfs`;
- `size`: (columns, left edge, right edge), of a word of several rows; `safe` (words; uint64): the cells that
  no mover comes to.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, FAR, cheaper, make_scratch, totals_of_way, write_totals
from sim.batch.reachability import (
    ALL_FIXED,
    BRAKES,
    NOW_LEFT,
    NOW_RIGHT,
    NOW_WALKERS,
    REACHED,
    RESTING_IN_HOLES,
    STAY,
    VEHICLE,
    YIELDS,
    expand,
    first_step,
    longest_survival,
    roll,
    search,
    someone_brakes,
)
from sim.batch.row_motion import beside_row
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def cost_scratch(rows, columns, max_ticks, weights, depth):
    """Room for decisions by cost, and the size of a word; `depth`: as for `make_scratch`."""
    per_word = 64 // columns
    left_edge = _ZERO
    for row in range(per_word):
        left_edge |= _ONE << np.uint64(row * columns)
    scratch = make_scratch(-(-rows // per_word), rows, columns, max_ticks, weights[BUFFER], depth)
    scratch[0][:] = _ZERO
    return scratch, (columns, left_edge, left_edge << np.uint64(columns - 1))


@compiled
def no_scratch():
    """No room, for planners that do not go by cost."""
    scratch = (
        np.zeros((1, 1), np.uint64),
        np.empty((1, 1, 1), np.uint64),
        np.empty((1, 1), np.uint64),
        np.empty((1, 1), np.int32),
        np.empty((1, 1, 1), np.int32),
        np.empty(1, np.int32),
    )
    return scratch, (1, _ONE, _ONE)


@compiled
def put_row(now, row, columns, right, left, walkers, fixed, holes):
    """Put a row into the words of what is seen now; rows are put in order, from row 0 on."""
    per_word = 64 // columns
    w, shift = row // per_word, np.uint64(row % per_word * columns)
    if shift == _ZERO:
        now[:, w] = _ZERO
    now[NOW_RIGHT, w] |= right << shift
    now[NOW_LEFT, w] |= left << shift
    now[NOW_WALKERS, w] |= walkers << shift
    now[ALL_FIXED, w] |= fixed << shift
    now[RESTING_IN_HOLES, w] |= ((right | left) & holes) << shift


@compiled
def put_vehicle(now, cell, columns, yields, brakes):
    """Put the vehicle into its row, and who reacts to it."""
    per_word, row = 64 // columns, cell // columns
    w, shift = row // per_word, np.uint64(row % per_word * columns)
    now[VEHICLE, w] = _ONE << np.uint64(cell % columns) << shift
    now[YIELDS, w] = yields << shift
    now[BRAKES, w] = brakes << shift


@compiled
def safe_words(movers, fixed, columns, last_bit):
    """The cells that no mover comes to: none is in their part of the row."""
    per_word, rows = 64 // columns, movers.size
    whole = (last_bit - _ONE) | last_bit
    safe = np.zeros(-(-rows // per_word), np.uint64)
    for row in range(rows):
        moving, wider = _ZERO, movers[row] & ~fixed[row]
        while wider != moving:
            moving = wider
            wider = beside_row(moving, last_bit) & ~fixed[row]
        shift = np.uint64(row % per_word * columns)
        safe[row // per_word] |= (whole & ~(fixed[row] | moving)) << shift
    return safe


@compiled
def _keeps_clear(now, layers, safe, rolled, limit, last, episode_tick, size, swept):
    """The ticks for which one keeps clear from what is reached after the first, and the layers rolled."""
    columns, left_edge, right_edge = size
    ticks = 1
    while ticks < limit:
        for w in range(last + 1):
            if layers[ticks, REACHED, w] & safe[w]:
                return limit, rolled
        if ticks >= rolled:
            roll(now, layers, ticks, last, episode_tick, columns, left_edge, right_edge, swept, False)
            rolled = ticks + 1
        if not expand(layers, ticks, 0, last, columns, left_edge, right_edge):
            return ticks, rolled
        ticks += 1
    return ticks, rolled


@compiled
def _longest(now, layers, safe, limit, last, episode_tick, size, swept):
    """The move after which one keeps clear longest, and for how many ticks; to stay where none is free."""
    columns, left_edge, right_edge = size
    roll(now, layers, 0, last, episode_tick, columns, left_edge, right_edge, swept, False)
    rolled, best, best_ticks = 1, STAY, 0
    for move in range(6):
        if first_step(now, layers, move, last, columns, left_edge, right_edge):
            ticks, rolled = _keeps_clear(now, layers, safe, rolled, limit, last, episode_tick, size, swept)
            if ticks > best_ticks:
                best, best_ticks = move, ticks
            if best_ticks == limit:
                break
    return best, best_ticks


@compiled
def cheapest_move(scratch, size, safe, cell, last_row, episode_tick, limit, swept, weights, hopeless):
    """The move of a cheapest way from what is seen now; with none, the one after which one lasts longest.

    `last_row`: the last that was put. `hopeless`: whether it is known that no way leads to the goal.
    """
    now, layers = scratch[0], scratch[1]
    columns, left_edge, right_edge = size
    row, last = cell // columns, last_row // (64 // columns)
    before = now[:, : last + 1].copy()
    least, move, lasted = FAR, np.intp(STAY), 0
    for stands in (False, True):
        if stands:
            if lasted == limit or not someone_brakes(now, layers, last):
                break
            now[:, : last + 1] = before
        elif hopeless:
            best, lasted = _longest(now, layers, safe, limit, last, episode_tick, size, swept)
            move = np.intp(best)
            continue
        ticks, rolled, kept_clear = search(
            now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
        )
        if ticks >= 0:
            totals_of_way(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept)
            least, move = cheaper(scratch, stands, least, move)
        elif least == FAR and not stands:
            best, lasted = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)
            move = np.intp(best)
        elif least == FAR and kept_clear > lasted:
            move = np.intp(STAY)
    return move


@compiled
def has_plan(scratch):
    """Whether a way was found by `cheapest_move`, before which the totals were `FAR`."""
    return scratch[5].min() < FAR


@compiled
def planned_move(scratch, ahead, cell, weights, columns):
    """The move of a cheapest way so many ticks after `cheapest_move`, where all has come as it foresaw.

    It was made from there as it was told to, and nobody has reacted or does now.
    """
    write_totals(scratch, ahead, cell, weights, columns)
    return np.argmin(scratch[5])
