"""One decision by cost in compiled words: what every move costs in all, from what one vehicle sees.

Structure: as `sim.batch.backward_dp`, whose sweep it uses; but where that stops at the cheapest move, here
the horizon grows until the cost of every move is proved. A way of more ticks than were swept costs at least a
tick for each, so a total that is no more than that is exact, and any other one tells how far the sweep must
go. A move whose cells all run out leads nowhere, which the sets of cells show.
Guarantee: the totals of `sim.search.backward_dp.totals_by_move` and the move of
`sim.search.reachability.longest_lasting`, for what
`sim.batch.percept_words.is_compiled_for` accepts.

Array arguments, besides those of `sim.batch.backward_dp`: `seen` (7, words; uint64) holds the boards of the
percept in the order of `NOW_RIGHT`, without the vehicle.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.backward_dp import (
    BUFFER,
    FAR,
    TICK,
    around,
    cheaper,
    cost_of_way,
    make_scratch,
    sweep,
    totals_of_way,
)
from sim.batch.compiled import max_ticks
from sim.batch.reachability import (
    ALL_FIXED,
    REACHED,
    STAY,
    VEHICLE,
    expand,
    first_step,
    keep_shortest,
    longest_survival,
    roll,
    search,
    someone_brakes,
)
from sim.batch.seen_otherwise import see
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def take(now, seen, cell, columns):
    """Begin a roll-out at what is seen."""
    rows_per_word = 64 // columns
    now[:VEHICLE] = seen
    now[VEHICLE] = _ZERO
    row = cell // columns
    now[VEHICLE, row // rows_per_word] = _ONE << np.uint64(row % rows_per_word * columns + cell % columns)


@compiled
def _arrives(now, layers, move, rolled, limit, last, episode_tick, columns, left_edge, right_edge, swept):
    """Ticks of the quickest way that begins with a move (−1: none), and the layers rolled by then."""
    goal = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    if not first_step(now, layers, move, last, columns, left_edge, right_edge):
        return -1, rolled
    if layers[1, REACHED, 0] & goal:
        return 1, rolled
    for ahead in range(1, limit):
        if ahead >= rolled:
            roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, False)
            rolled = ahead + 1
        if not expand(layers, ahead, 0, last, columns, left_edge, right_edge):
            return -1, rolled
        if layers[ahead + 1, REACHED, 0] & goal:
            return ahead + 1, rolled
    return -1, rolled


@compiled
def _every_total(scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept, stay_only):
    """Write the totals of the moves now, each of them proved; `ticks`: those of a quickest way.

    With `stay_only` that of staying alone is asked for. `scratch`, `size`: as in `sim.batch.backward_dp`.
    """
    now, layers, near = scratch[0], scratch[1], scratch[2]
    totals = scratch[5]
    columns, left_edge, right_edge = size
    keep_shortest(layers, ticks, cell // columns, last, columns, left_edge, right_edge)
    around(now[ALL_FIXED], near[0], last, columns, left_edge, right_edge)
    bound = cost_of_way(layers, near, ticks, cell, last, weights, columns, left_edge, right_edge)
    horizon = min(bound // weights[TICK], limit)
    hopeless = np.zeros(6, np.bool_)
    while True:
        for ahead in range(rolled, horizon):
            roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, False)
        rolled = max(rolled, horizon)
        sweep(scratch, horizon, cell, last, weights, size)
        if stay_only or horizon >= limit:
            return
        needed = horizon
        for move in range(6):
            if hopeless[move]:
                continue
            total = np.int64(totals[move])
            if total >= FAR:
                quickest, rolled = _arrives(
                    now,
                    layers,
                    move,
                    rolled,
                    limit,
                    last,
                    episode_tick,
                    columns,
                    left_edge,
                    right_edge,
                    swept,
                )
                if quickest < 0:
                    hopeless[move] = True
                else:
                    needed = max(needed, quickest)
            elif total > (horizon + 1) * weights[TICK]:
                needed = max(needed, total // weights[TICK])
        if needed <= horizon:
            return
        horizon = min(needed, limit)


@compiled
def made_move(scratch, seen, cell, episode_tick, limit, size, swept, last, weights):
    """The move that is made where this is seen, and what it costs with the cheapest way on (`FAR`: no way).

    `scratch`, `size`: as in `sim.batch.backward_dp`.
    """
    now, layers = scratch[0], scratch[1]
    columns, left_edge, right_edge = size
    row = cell // columns
    least, move, lasted = FAR, np.intp(STAY), 0
    for stands in (False, True):
        if stands and not someone_brakes(now, layers, last):
            break
        take(now, seen, cell, columns)
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
    return move, least


@compiled
def made_moves(
    planes,
    parts,
    chosen,
    cell,
    columns,
    rows,
    left_edge,
    right_edge,
    episode_tick,
    limit,
    swept,
    last,
    weights,
    moves,
):
    """Write the move that is made after each change (`chosen`: changes, parts of each).

    Each is weighed by its own row of `weights`. `planes`, `parts`: as in `sim.batch.seen_otherwise`.
    """
    scratch = make_scratch(planes.shape[1], rows, columns, max_ticks(rows), weights[:, BUFFER].max(), 1)
    seen = np.empty((VEHICLE, planes.shape[1]), np.uint64)
    size = columns, left_edge, right_edge
    for number in range(chosen.shape[0]):
        see(seen, planes, parts, chosen[number])
        moves[number] = made_move(
            scratch, seen, cell, episode_tick, limit, size, swept, last, weights[number]
        )[0]


@compiled
def decided_totals(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, out
):
    """Write what each move costs in all (−1: no way); returns the move after which one lasts longest.

    Returns −1 where a way leads to the goal.
    """
    scratch = make_scratch(seen.shape[1], rows, columns, max_ticks(rows), weights[BUFFER], 1)
    now, layers, totals = scratch[0], scratch[1], scratch[5]
    size = columns, left_edge, right_edge
    row = cell // columns
    out[:] = -1
    found, lasting, lasted = False, np.intp(STAY), 0
    for stands in (False, True):
        if stands and not someone_brakes(now, layers, last):
            break
        take(now, seen, cell, columns)
        ticks, rolled, kept_clear = search(
            now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
        )
        if ticks >= 0:
            found = True
            _every_total(
                scratch, ticks, rolled, cell, last, weights, episode_tick, limit, size, swept, stands
            )
            for move in range(STAY if stands else 0, 6):
                out[move] = totals[move] if totals[move] < FAR else -1
        elif not stands:
            lasting, lasted = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)
        elif kept_clear > lasted:
            lasting = np.intp(STAY)
    return np.intp(-1) if found else lasting
