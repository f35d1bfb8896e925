"""What a vehicle sees as compiled words, and the decisions by cost that are taken of it (`one_decision`)."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from typing import Final

import numpy as np

from sim.batch.backward_dp import BUFFER
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
from sim.world.grid import Board, union

_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)
WORD_BITS: Final = 64
MOST_COLUMNS: Final = WORD_BITS
"""Columns of the widest road that fits into words."""
_WALKERS: Final = MARKED.index(Kind.PEDESTRIAN)


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
    seen = np.frombuffer(bytearray(_Planes(percept, last).words(Unlike())), np.uint64)
    out = np.empty(6, np.int64)
    place = *_place(percept, limit), last
    lasting = decided_totals(seen.reshape(VEHICLE, last + 1), *place, np.array(_row(weights), np.int64), out)
    totals = tuple([None if total < 0 else total for total in out.tolist()])
    return totals, None if lasting < 0 else int(lasting)


class MoveKernel:
    """The moves that are made where what one vehicle sees is otherwise, each time in another way."""

    def __init__(self, percept: Percept, limit: int) -> None:
        """`limit`: steps that are left, in ticks. Precondition: `is_compiled_for`, with all charges asked."""
        self._percept = percept
        self._place = _place(percept, limit)
        self._planes: dict[int, _Planes] = {}
        self._rows: dict[Weights, tuple[int, ...]] = {}

    def moves(self, unlike: Sequence[Unlike], weights: Sequence[Weights]) -> list[Move]:
        """The move where each of these things is seen otherwise, by the charges beside it; at least one."""
        rows = [self._row(each) for each in weights]
        last = _last_word(self._percept, max([row[BUFFER] for row in rows]))
        planes = self._planes.get(last)
        if planes is None:
            planes = self._planes[last] = _Planes(self._percept, last)
        words = bytearray().join([planes.words(each) for each in unlike])
        seen = np.frombuffer(words, np.uint64).reshape(len(unlike), VEHICLE, last + 1)
        moves = np.empty(len(unlike), np.uint8)
        made_moves(seen, *self._place, last, np.array(rows, np.int64), moves)
        return [MOVES[move] for move in moves.tolist()]

    def _row(self, weights: Weights) -> tuple[int, ...]:
        row = self._rows.get(weights)
        if row is None:
            row = self._rows[weights] = _row(weights)
        return row


class _Planes:
    """The boards of what is seen as one number, plane after plane in the order of `NOW_RIGHT`.

    Python changes a long number as quickly as a short one, so a way to see takes few operations.
    """

    def __init__(self, percept: Percept, last: int) -> None:
        """`last`: the last word that matters."""
        columns = percept.road.columns
        self._bits, self._words = WORD_BITS // columns * columns, range(last + 1)
        self._near = (1 << self._bits * (last + 1)) - 1
        plane = WORD_BITS * (last + 1)
        self._fixed_at, self._held_at = 3 * plane, 4 * plane
        self._size = VEHICLE * plane // 8
        boards = percept.boards
        self._movers = self._laid(percept.right | percept.left)
        self._fixed, self._holding = self._laid(boards.fixed), self._laid(boards.holding)
        # Whatever is of movers goes with them; what is fixed, and who rests in a hole, is put in each time.
        walkers = self._laid(boards.marked[_WALKERS])
        right, left = self._laid(percept.right), self._laid(percept.left)
        yielding, attentive = self._laid(percept.yielding), self._laid(percept.attentive)
        of_movers = (right, left, walkers, 0, 0, yielding, attentive)
        self._of_movers = sum(board << number * plane for number, board in enumerate(of_movers))
        self._each_plane = sum(1 << number * plane for number in (0, 1, 2, 5, 6))

    def words(self, unlike: Unlike) -> bytes:
        """What is seen so: (7, words; uint64)."""
        gone, gone_fixed, barriers, potholes = [self._laid(board) if board else 0 for board in unlike]
        movers, rest = self._movers & ~gone, ~gone_fixed
        fixed = self._fixed & rest | barriers | potholes
        held = movers & (self._holding & rest | potholes)
        of_movers = self._of_movers & ~(gone * self._each_plane) if gone else self._of_movers
        seen = of_movers | fixed << self._fixed_at | held << self._held_at
        return seen.to_bytes(self._size, "little")

    def _laid(self, board: Board) -> int:
        """A board as words: rows fill a word from its first bit, and none lies across two."""
        board &= self._near
        if self._bits == WORD_BITS:
            return board
        mask = (1 << self._bits) - 1
        words = [(board >> word * self._bits & mask) << word * WORD_BITS for word in self._words]
        return union(words)


def _last_word(percept: Percept, buffer: int) -> int:
    """The last word of what matters: that of the row as far behind the ego as movers are kept clear of."""
    road = percept.road
    row = min(percept.ego // road.columns + max(1, buffer), road.rows - 1)
    return row // Layout.of(road.columns, road.rows).rows_per_word


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
