"""What is kept of one road (the base), so that decisions on roads much like it take little time.

It is the decision on that road. Where a way leads to the destination, it is the costs of every row as well;
where none does, how far the vehicle gets and which row shuts the road.

Array arguments: as in `sim.batch.one_decision` and `sim.batch.row_sweep`; `facts` (2, 5; int64): what is
known of the base, see `GOING` and `LEAST`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, FAR, cheaper, make_scratch, totals_of_way
from sim.batch.compiled import max_ticks, spread_back
from sim.batch.one_decision import made_move, take
from sim.batch.reachability import (
    ALL_FIXED,
    BLOCKED,
    CAME_LEFT,
    CAME_RIGHT,
    CUT_LEFT,
    CUT_RIGHT,
    MOVERS,
    NEEDED,
    REACHED,
    STAY,
    longest_survival,
    roll,
    search,
    someone_brakes,
)
from sim.batch.row_sweep import FROM_LEFT, FROM_RIGHT, STANDING, sweep_forward, sweep_row
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)

GOING, STANDING_STILL = range(2)
"""Rows of the facts. Where a mover brakes for a vehicle that stays, staying is decided by itself: the first
row is of all moves, by movers that do not brake, the second one of staying, by movers that do."""
LEAST, MOVE, REACHED_ROW, SHUT_ROW, BRAKED = range(5)
"""Columns of the facts: the least cost to the destination (`FAR`: no way); the move, in the second row that
of the whole decision; where there is no way, the foremost row that the vehicle gets to, and the foremost one
from which nothing leads to the destination; and in the first row, whether a mover brakes."""
FACTS: Final = 5
SPARE_TICKS: Final = 3
"""Ticks that are swept beyond what the cheapest way of the base can take, for ways that become dearer."""


@compiled
def decide_base(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, facts
):
    """Take the decision of the base, and write what is known of it (`facts`: 2, 5; int64)."""
    scratch = make_scratch(seen.shape[1], rows, columns, max_ticks(rows), weights[BUFFER], 1)
    now, layers = scratch[0], scratch[1]
    size, row = (columns, left_edge, right_edge), cell // columns
    for stands in (False, True):
        if stands and not facts[GOING, BRAKED]:
            facts[STANDING_STILL, MOVE] = facts[GOING, MOVE]
            break
        take(now, seen, cell, columns)
        ticks, rolled, _ = search(
            now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
        )
        known = facts[STANDING_STILL if stands else GOING]
        if not stands:
            known[BRAKED] = 1 if someone_brakes(now, layers, last) else 0
        if ticks >= 0:
            totals_of_way(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept)
            known[LEAST], known[MOVE] = cheaper(scratch, stands, FAR, np.intp(STAY))
            continue
        known[LEAST] = FAR
        known[REACHED_ROW] = _foremost_reached(layers, rolled, row, columns)
        for ahead in range(rolled, limit):
            roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands)
        known[SHUT_ROW] = _shut_row(layers, limit, row, last, columns, left_edge, right_edge)
        if not stands:
            known[MOVE] = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)[0]
    if facts[GOING, BRAKED]:
        facts[STANDING_STILL, MOVE] = made_move(
            scratch, seen, cell, episode_tick, limit, size, swept, last, weights
        )[0]


@compiled
def _foremost_reached(layers, rolled, start_row, columns):
    """The foremost row that the vehicle gets to in the ticks rolled."""
    rows_per_word = 64 // columns
    mask = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    row = start_row
    for ahead in range(1, rolled + 1):
        w, shift = (row - 1) // rows_per_word, np.uint64((row - 1) % rows_per_word * columns)
        # It gains a row a tick at most: further on nothing is written yet.
        if row > start_row - ahead and layers[ahead, REACHED, w] >> shift & mask:
            row -= 1
    return row


@compiled
def _shut_row(layers, limit, start_row, last, columns, left_edge, right_edge):
    """The foremost row from which nothing leads to the destination within the limit."""
    rows_per_word = 64 // columns
    down, most = np.uint64(64 - columns - 64 % columns), np.uint64(columns - 1)
    goal = (_ONE << most << _ONE) - _ONE
    leading = np.zeros(last + 1, np.uint64)
    for w in range(last + 1):
        layers[limit, NEEDED, w] = _ZERO
    layers[limit, NEEDED, 0] = goal
    for ahead in range(limit - 1, -1, -1):
        on_before = _ZERO  # of the word before: its last row leads to the first of the next
        for w in range(last + 1):
            end = layers[ahead + 1, NEEDED, w]
            level, on = spread_back(
                end ^ end & layers[ahead, BLOCKED, w],
                layers[ahead, CAME_RIGHT, w],
                layers[ahead, CAME_LEFT, w],
                layers[ahead, CUT_LEFT, w],
                layers[ahead, CUT_RIGHT, w],
                left_edge,
                right_edge,
            )
            kept = level | on << most << _ONE | on_before >> down
            if w == 0:
                kept |= goal
            layers[ahead, NEEDED, w] = kept
            leading[w] |= kept
            on_before = on
    for row in range(1, start_row + 1):
        if not leading[row // rows_per_word] >> np.uint64(row % rows_per_word * columns) & goal:
            return row
    return start_row + 1


@compiled
def keep_costs(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, swept, last, weights, kept, stands
):
    """Keep the costs of a base with a way; `kept`: (slots, lines, fixed, entering, getting).

    The ticks of `getting` are those that are swept. With `stands` the vehicle stays in the first one.
    """
    slots, lines, fixed, entering, getting = kept
    known, horizon = slots.shape[1], getting.shape[1]
    scratch = make_scratch(seen.shape[1], rows, columns, horizon, 0, 1)
    now, layers = scratch[0], scratch[1]
    take(now, seen, cell, columns)
    for ahead in range(horizon):
        roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, stands)
    rows_per_word = 64 // columns
    mask = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    for row in range(known):
        slots[:, row] = row
        w, shift = row // rows_per_word, np.uint64(row % rows_per_word * columns)
        there = row < rows
        fixed[row] = now[ALL_FIXED, w] >> shift & mask if there else _ZERO
        for ahead in range(horizon):
            lines[row, ahead, STANDING] = layers[ahead, MOVERS, w] >> shift & mask if there else _ZERO
            lines[row, ahead, FROM_LEFT] = layers[ahead, CAME_RIGHT, w] >> shift & mask if there else _ZERO
            lines[row, ahead, FROM_RIGHT] = layers[ahead, CAME_LEFT, w] >> shift & mask if there else _ZERO
    start_row = cell // columns
    entering[:] = FAR
    for row in range(start_row + 1):
        sweep_row(entering, lines, fixed, slots, row, horizon, start_row, weights, columns, swept)
    getting[:] = FAR
    sweep_forward(getting, lines, fixed, slots, cell, horizon, weights, columns, swept, stands)
