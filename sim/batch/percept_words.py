"""What a vehicle sees as compiled words, and the decisions by cost that are taken of it (`one_decision`)."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.batch.layout import Layout
from sim.batch.one_decision import decided_totals, made_moves
from sim.batch.reachability import VEHICLE
from sim.batch.row_words import make_ready as make_rows_ready
from sim.compiled_files import ready_mark
from sim.forecast import Forecast
from sim.perceive import Percept
from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.search.compiled_costs import COMPILED, Unlike
from sim.search.costs import Weights
from sim.types import MARKED, MOVES, Kind, Move

_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)
WORD_BITS: Final = 64
MOST_COLUMNS: Final = WORD_BITS
"""Columns of the widest road that fits into words."""
_WALKERS: Final = MARKED.index(Kind.PEDESTRIAN)
_MANY: Final = 4
"""Ways to see from which on they are put into words together."""


def make_ready() -> None:
    """Compile this, or load what was compiled before."""
    seen = np.zeros((VEHICLE, 1), np.uint64)
    charges, out = np.array((60, 12, 9, 4, 2, 24, 1), np.int64), np.empty(6, np.int64)
    place = (1, 1, 2, _ONE, _ONE, 0, 2, _ALL, 0)
    decided_totals(seen, *place, charges, out)
    made_moves(seen[None], *place, charges[None], np.empty(1, np.uint8))
    make_rows_ready()
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
    lasting = decided_totals(seen, *_place(percept, limit), last, np.array(_row(weights), np.int64), out)
    totals = tuple([None if total < 0 else total for total in out.tolist()])
    return totals, None if lasting < 0 else int(lasting)


def moves_of(
    percept: Percept, unlike: Sequence[Unlike], weights: Sequence[Weights], limit: int
) -> list[Move]:
    """The move that is made where each of these things is seen otherwise, by the charges beside it.

    Precondition: `is_compiled_for` with each of the charges, and no ways to see less than one.
    """
    usual = weights[0]
    alike = all(each is usual for each in weights)
    last = _last_word(percept, usual.buffer if alike else max([each.buffer for each in weights]))
    seen = _seen_otherwise(percept, unlike, last)
    moves = np.empty(len(unlike), np.uint8)
    rows = np.array([_row(usual)] if alike else [_row(each) for each in weights], np.int64)
    charges = np.repeat(rows, len(unlike), 0) if alike else rows
    made_moves(seen, *_place(percept, limit), last, charges, moves)
    return [MOVES[move] for move in moves.tolist()]


def _last_word(percept: Percept, buffer: int) -> int:
    """The last word of what matters: that of the row as far behind the ego as movers are kept clear of."""
    road = percept.road
    row = min(percept.ego // road.columns + max(1, buffer), road.rows - 1)
    return row // Layout.of(road.columns, road.rows).rows_per_word


def _seen_otherwise(percept: Percept, unlike: Sequence[Unlike], last: int) -> NDArray[np.uint64]:
    """What is seen, each time otherwise (ways to see, 7, words up to the last)."""
    shape = len(unlike), VEHICLE, last + 1
    if len(unlike) < _MANY:
        words = b"".join([_words(percept, each, last) for each in unlike])
        return np.frombuffer(bytearray(words), np.uint64).reshape(shape)
    boards = percept.boards
    usual = (
        percept.right,
        percept.left,
        boards.marked[_WALKERS],
        boards.fixed,
        boards.holding,
        percept.yielding,
        percept.attentive,
    )
    right, left, walkers, fixed, holding, yielding, attentive = _as_words(percept, usual, last)
    gone, gone_fixed, barriers, potholes = (
        _as_words(percept, [each[plane] for each in unlike], last) for plane in range(4)
    )
    stay, rest = ~gone, ~gone_fixed
    seen = np.empty(shape, np.uint64)
    seen[:, 0], seen[:, 1], seen[:, 2] = right & stay, left & stay, walkers & stay
    seen[:, 3] = fixed & rest | barriers | potholes
    seen[:, 4] = (seen[:, 0] | seen[:, 1]) & (holding & rest | potholes)
    seen[:, 5], seen[:, 6] = yielding & stay, attentive & stay
    return seen


def _as_words(percept: Percept, boards: Sequence[int], last: int) -> NDArray[np.uint64]:
    """The words up to the last of each of these boards."""
    words = b"".join(_bytes_of(percept, boards, last))
    return np.frombuffer(words, np.uint64).reshape(len(boards), last + 1)


def _words(percept: Percept, unlike: Unlike, last: int) -> bytes:
    """What is seen, in the order of `NOW_RIGHT` without the vehicle: the words up to the last."""
    boards = percept.boards
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
    return b"".join(_bytes_of(percept, seen, last))


def _bytes_of(percept: Percept, boards: Sequence[int], last: int) -> list[bytes]:
    """The words up to the last of boards, one after the other."""
    columns = percept.road.columns
    size = WORD_BITS // columns * columns
    if size == WORD_BITS:
        length, near = 8 * (last + 1), (1 << WORD_BITS * (last + 1)) - 1
        return [(board & near).to_bytes(length, "little") for board in boards]
    words, mask = range(last + 1), (1 << size) - 1
    return [(board >> word * size & mask).to_bytes(8, "little") for board in boards for word in words]


@lru_cache(maxsize=64)
def _edges(columns: int, rows: int) -> tuple[np.uint64, np.uint64]:
    """The first and the last column of a word."""
    layout = Layout.of(columns, rows)
    return np.uint64(layout.left_edge), np.uint64(layout.right_edge)


def _place(percept: Percept, limit: int) -> tuple[object, ...]:
    """Where and when it is decided, as the kernels want it."""
    road = percept.road
    left_edge, right_edge = _edges(road.columns, road.rows)
    return (
        percept.ego,
        road.columns,
        road.rows,
        left_edge,
        right_edge,
        percept.episode_tick,
        limit,
        _ALL if percept.swept else np.uint64(0),
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
