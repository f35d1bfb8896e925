"""One decision by cost in compiled words: what every move costs in all, from what one vehicle sees.

Structure: as `sim.batch.backward_dp`, whose sweep it uses; but where that stops at the cheapest move, here
the horizon grows until the cost of every move is proved. A way of more ticks than were swept costs at least a
tick for each, so a total that is no more than that is exact, and any other one tells how far the sweep must
go. A move whose cells all run out leads nowhere, which the sets of cells show.
Guarantee: the totals of `sim.search.backward_dp.totals_by_move` and the move of
`sim.search.reachability.longest_lasting`, for what `is_compiled_for` accepts.

Array arguments, besides those of `sim.batch.backward_dp`: `seen` (7, words; uint64) holds the boards of the
percept in the order of `NOW_RIGHT`, without the vehicle.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER, FAR, TICK, _around, _cost_of_way, _sweep, _totals_of_way
from sim.batch.compiled import compiled, free_steps, max_ticks
from sim.batch.layout import Layout
from sim.batch.reachability import (
    ALL_FIXED,
    BLOCKED,
    BOARDS,
    CAME_LEFT,
    CAME_RIGHT,
    CUT_LEFT,
    CUT_RIGHT,
    FIELDS,
    REACHED,
    STAY,
    VEHICLE,
    expand,
    keep_shortest,
    longest_survival,
    one_row_on,
    roll,
    search,
    someone_brakes,
)
from sim.compiled_files import ready_mark
from sim.forecast import Forecast
from sim.perceive import Percept
from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.search.compiled_costs import COMPILED, Unlike
from sim.search.costs import Weights
from sim.types import MARKED, MOVES, Kind, Move

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)
WORD_BITS: Final = 64
_WALKERS: Final = MARKED.index(Kind.PEDESTRIAN)
MOST_COLUMNS: Final = 64
"""Columns of the widest road that fits into words."""


@compiled
def _take(now, seen, cell, columns):
    """Begin a roll-out at what is seen."""
    rows_per_word = 64 // columns
    now[:VEHICLE] = seen
    now[VEHICLE] = _ZERO
    row = cell // columns
    now[VEHICLE, row // rows_per_word] = _ONE << np.uint64(row % rows_per_word * columns + cell % columns)


@compiled
def _first_step(now, layers, move, last, columns, left_edge, right_edge):
    """Put where a move leads now into layer 1; whether it meets nothing."""
    vehicle = now[VEHICLE]
    alive = _ZERO
    for w in range(last + 1):
        steps = free_steps(
            vehicle[w],
            one_row_on(vehicle, w, last, columns),
            layers[0, BLOCKED, w],
            layers[0, CAME_RIGHT, w],
            layers[0, CAME_LEFT, w],
            layers[0, CUT_LEFT, w],
            layers[0, CUT_RIGHT, w],
            left_edge,
            right_edge,
        )
        there = (
            steps.forward,
            steps.left,
            steps.right,
            steps.forward_left,
            steps.forward_right,
            steps.stay,
        )[move]
        layers[1, REACHED, w] = there
        alive |= there
    return alive != _ZERO


@compiled
def _arrives(now, layers, move, rolled, limit, last, episode_tick, columns, left_edge, right_edge, swept):
    """Ticks of the quickest way that begins with a move (−1: none), and the layers rolled by then."""
    goal = (_ONE << np.uint64(columns - 1) << _ONE) - _ONE
    if not _first_step(now, layers, move, last, columns, left_edge, right_edge):
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
    _around(now[ALL_FIXED], near[0], last, columns, left_edge, right_edge)
    bound = _cost_of_way(layers, near, ticks, cell, last, weights, columns, left_edge, right_edge)
    horizon = min(bound // weights[TICK], limit)
    hopeless = np.zeros(6, np.bool_)
    while True:
        for ahead in range(rolled, horizon):
            roll(now, layers, ahead, last, episode_tick, columns, left_edge, right_edge, swept, False)
        rolled = max(rolled, horizon)
        _sweep(scratch, horizon, cell, last, weights, size)
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
def _moves(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, moves
):
    """Write the move that is made where each of these is seen (`seen`: ways to see, 7, words).

    Each is weighed by its own row of `weights`.
    """
    words = seen.shape[2]
    now = np.empty((BOARDS, words), np.uint64)
    layers = np.empty((max_ticks(rows) + 3, FIELDS, words), np.uint64)
    near = np.empty((2 + weights[:, BUFFER].max(), words), np.uint64)
    value = np.full((rows, columns + 2), FAR, np.int32)
    entering = np.full((rows, columns + 2), FAR, np.int32)
    totals = np.full(6, FAR, np.int32)
    scratch = now, layers, near, value, entering, totals
    size = columns, left_edge, right_edge
    row = cell // columns
    for number in range(seen.shape[0]):
        least, move, lasted = FAR, np.intp(STAY), 0
        for stands in (False, True):
            if stands and not someone_brakes(now, layers, last):
                break
            _take(now, seen[number], cell, columns)
            ticks, rolled, kept_clear = search(
                now, layers, row, last, episode_tick, limit, columns, left_edge, right_edge, swept, stands
            )
            if ticks >= 0:
                _totals_of_way(
                    scratch,
                    ticks,
                    rolled,
                    cell,
                    last,
                    weights[number],
                    episode_tick,
                    limit,
                    size,
                    swept,
                )
                if stands:
                    totals[:STAY] = FAR
                if totals.min() < least:
                    move = np.argmin(totals)
                    least = totals[move]
            elif least == FAR and not stands:
                move, lasted = longest_survival(now, layers, rolled, last, columns, left_edge, right_edge)
            elif least == FAR and kept_clear > lasted:
                move = np.intp(STAY)
        moves[number] = move


@compiled
def _decided(
    seen, cell, columns, rows, left_edge, right_edge, episode_tick, limit, swept, last, weights, out
):
    """Write what each move costs in all (−1: no way); returns the move after which one lasts longest.

    Returns −1 where a way leads to the goal.
    """
    words = seen.shape[1]
    now = np.empty((BOARDS, words), np.uint64)
    layers = np.empty((max_ticks(rows) + 3, FIELDS, words), np.uint64)
    near = np.empty((2 + weights[BUFFER], words), np.uint64)
    value = np.full((rows, columns + 2), FAR, np.int32)
    entering = np.full((rows, columns + 2), FAR, np.int32)
    totals = np.full(6, FAR, np.int32)
    scratch = now, layers, near, value, entering, totals
    size = columns, left_edge, right_edge
    row = cell // columns
    out[:] = -1
    found, lasting, lasted = False, np.intp(STAY), 0
    for stands in (False, True):
        if stands and not someone_brakes(now, layers, last):
            break
        _take(now, seen, cell, columns)
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


def make_ready() -> None:
    """Compile this, or load what was compiled before."""
    seen = np.zeros((VEHICLE, 1), np.uint64)
    charges, out = np.array((60, 12, 9, 4, 2, 24, 1), np.int64), np.empty(6, np.int64)
    place = (1, 1, 2, _ONE, _ONE, 0, 2, _ALL, 0)
    _decided(seen, *place, charges, out)
    _moves(seen[None], *place, charges[None], np.empty(1, np.uint8))
    mark = ready_mark(COMPILED)
    if mark is not None:
        with suppress(OSError):
            mark.touch()


def totals_where_compiled(
    forecast: Forecast, weights: Weights, limit: int
) -> tuple[tuple[int | None, ...], int | None] | None:
    """`totals_of` of what `is_compiled_for`, else None."""
    return totals_of(forecast, weights, limit) if is_compiled_for(forecast.percept, weights, limit) else None


def is_compiled_for(percept: Percept, weights: Weights, limit: int) -> bool:
    """Whether a decision of what is seen can be taken here: by the motion, the movers and the charges."""
    return (
        not percept.egos
        and percept.behaviour == DEFAULT_BEHAVIOUR
        and percept.dynamics == DEFAULT_DYNAMICS
        and limit > 1
        and percept.road.columns <= MOST_COLUMNS
        and not (weights.doubt and any(percept.doubtful))
        and percept.boards.others == percept.boards.marked[_WALKERS]
    )


def totals_of(forecast: Forecast, weights: Weights, limit: int) -> tuple[tuple[int | None, ...], int | None]:
    """What each move costs in all (None: no way), and the move after which one lasts longest where none has.

    `limit`: steps that are left, in ticks. Precondition: `is_compiled_for`.
    """
    percept = forecast.percept
    last = _last_word(percept, weights.buffer)
    seen = np.frombuffer(bytearray(_words(percept, Unlike(), last)), np.uint64).reshape(VEHICLE, last + 1)
    out = np.empty(6, np.int64)
    lasting = _decided(seen, *_place(percept, limit), last, np.array(_row(weights), np.int64), out)
    totals = tuple([None if total < 0 else total for total in out.tolist()])
    return totals, None if lasting < 0 else int(lasting)


def moves_of(
    percept: Percept, unlike: Sequence[Unlike], weights: Sequence[Weights], limit: int
) -> list[Move]:
    """The move that is made where each of these things is seen otherwise, by the charges beside it.

    Precondition: `is_compiled_for` with each of the charges, and no ways to see less than one.
    """
    last = _last_word(percept, max(each.buffer for each in weights))
    words = b"".join([_words(percept, each, last) for each in unlike])
    seen = np.frombuffer(bytearray(words), np.uint64).reshape(len(unlike), VEHICLE, last + 1)
    moves = np.empty(len(unlike), np.uint8)
    charges = np.array([_row(each) for each in weights], np.int64)
    _moves(seen, *_place(percept, limit), last, charges, moves)
    return [MOVES[move] for move in moves.tolist()]


def _last_word(percept: Percept, buffer: int) -> int:
    """The last word of what matters: that of the row as far behind the ego as movers are kept clear of."""
    road = percept.road
    row = min(percept.ego // road.columns + max(1, buffer), road.rows - 1)
    return row // Layout.of(road.columns, road.rows).rows_per_word


def _words(percept: Percept, unlike: Unlike, last: int) -> bytes:
    """What is seen, in the order of `NOW_RIGHT` without the vehicle: the words up to the last."""
    road, boards = percept.road, percept.boards
    size = Layout.of(road.columns, road.rows).rows_per_word * road.columns
    stay, rest = ~unlike.movers, ~unlike.fixed
    right, left = percept.right & stay, percept.left & stay
    held = boards.holding & rest | unlike.potholes
    seen = (
        right,
        left,
        boards.marked[_WALKERS] & stay,
        boards.fixed & rest | unlike.barriers | unlike.potholes,
        (right | left) & held,
        percept.yielding & stay,
        percept.attentive & stay,
    )
    if size == WORD_BITS:
        length, near = 8 * (last + 1), (1 << WORD_BITS * (last + 1)) - 1
        return b"".join([(board & near).to_bytes(length, "little") for board in seen])
    words, mask = range(last + 1), (1 << size) - 1
    return b"".join([(board >> word * size & mask).to_bytes(8, "little") for board in seen for word in words])


def _place(percept: Percept, limit: int) -> tuple[object, ...]:
    """Where and when it is decided, as the kernels want it."""
    road = percept.road
    layout = Layout.of(road.columns, road.rows)
    return (
        percept.ego,
        road.columns,
        road.rows,
        np.uint64(layout.left_edge),
        np.uint64(layout.right_edge),
        percept.episode_tick,
        limit,
        _ALL if percept.swept else _ZERO,
    )


def _row(weights: Weights) -> tuple[int, ...]:
    """The charges, in the order of `TICK`."""
    return (
        weights.tick,
        weights.sideways,
        weights.diagonal,
        weights.stay,
        weights.fixed,
        weights.mover,
        weights.buffer,
    )
