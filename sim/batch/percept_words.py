"""What a vehicle sees as compiled words, and the decisions by cost that are taken of it (`one_decision`)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.batch.layout import Layout
from sim.batch.one_decision import decided_totals
from sim.batch.reachability import VEHICLE
from sim.batch.seen_otherwise import NOTHING, SEEN_AS_IT_IS, see
from sim.perceive import Percept
from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.search.compiled_costs import Unlike
from sim.search.costs import Weights
from sim.types import MARKED, Kind
from sim.world.grid import Board, union

_ONE: Final = np.uint64(1)
_ALL: Final = np.uint64(2**64 - 1)
WORD_BITS: Final = 64
MOST_COLUMNS: Final = WORD_BITS
"""Columns of the widest road that fits into words."""
_WALKERS: Final = MARKED.index(Kind.PEDESTRIAN)


def totals_where_compiled(
    percept: Percept, weights: Weights, limit: int
) -> tuple[tuple[int | None, ...], int | None] | None:
    """`totals_of` of what `is_compiled_for`, else None."""
    return totals_of(percept, weights, limit) if is_compiled_for(percept, weights, limit) else None


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


def totals_of(percept: Percept, weights: Weights, limit: int) -> tuple[tuple[int | None, ...], int | None]:
    """What each move costs in all (None: no way), and the move after which one lasts longest where none has.

    `limit`: steps that are left, in ticks. Precondition: `is_compiled_for`.
    """
    last = last_word(percept, weights.buffer)
    seen, out = np.empty((VEHICLE, last + 1), np.uint64), np.empty(6, np.int64)
    see(seen, PerceptWords(percept, last).planes, NOTHING, SEEN_AS_IT_IS)
    lasting = decided_totals(seen, *place_of(percept, limit), last, charges_of(weights), out)
    totals = tuple([None if total < 0 else total for total in out.tolist()])
    return totals, None if lasting < 0 else int(lasting)


class PerceptWords:
    """What one vehicle sees, up to a word of the road, and other ways to see it."""

    def __init__(self, percept: Percept, last: int) -> None:
        """`last`: the last word that matters."""
        columns, boards = percept.road.columns, percept.boards
        self._bits, self._size = WORD_BITS // columns * columns, 8 * (last + 1)
        self._near = (1 << self._bits * (last + 1)) - 1
        self.bare = Unlike(percept.right | percept.left, boards.fixed)
        """how the road without anything on it differs"""
        planes = (
            percept.right,
            percept.left,
            boards.marked[_WALKERS],
            boards.fixed,
            boards.holding,
            percept.yielding,
            percept.attentive,
        )
        words = b"".join([self._laid(board) for board in planes])
        self.planes = np.frombuffer(words, np.uint64).reshape(len(planes), last + 1)
        """(7, words; uint64): the boards of the percept in the order of `sim.batch.seen_otherwise.HOLDING`"""

    def parts(self, unlike: Sequence[Unlike]) -> NDArray[np.uint64]:
        """These changes as words (changes, 4, words), in the order of `Unlike`."""
        parts = np.zeros((len(unlike), len(Unlike._fields), self._size // 8), np.uint64)
        for place, boards in enumerate(unlike):
            for kind, board in enumerate(boards):
                if not board:
                    continue
                if board & board - 1:
                    parts[place, kind] = np.frombuffer(self._laid(board), np.uint64)
                elif board & self._near:  # a single cell, as nearly always
                    word, at = divmod(board.bit_length() - 1, self._bits)
                    parts[place, kind, word] = 1 << at
        return parts

    def _laid(self, board: Board) -> bytes:
        """A board as words: rows fill a word from its first bit, and none lies across two."""
        board &= self._near
        if self._bits != WORD_BITS:
            mask, words = (1 << self._bits) - 1, range(self._size // 8)
            board = union([(board >> word * self._bits & mask) << word * WORD_BITS for word in words])
        return board.to_bytes(self._size, "little")


def last_word(percept: Percept, buffer: int) -> int:
    """The last word of what matters: that of the row as far behind the ego as movers are kept clear of."""
    road = percept.road
    row = min(percept.ego // road.columns + max(1, buffer), road.rows - 1)
    return row // Layout.of(road.columns, road.rows).rows_per_word


@lru_cache(maxsize=64)
def _edges(columns: int, rows: int) -> tuple[np.uint64, np.uint64]:
    """The first and the last column of a word."""
    layout = Layout.of(columns, rows)
    return np.uint64(layout.left_edge), np.uint64(layout.right_edge)


class Place(NamedTuple):
    """Where and when it is decided, as the kernels want it."""

    cell: int
    columns: int
    rows: int
    left_edge: np.uint64
    right_edge: np.uint64
    episode_tick: int
    limit: int
    """steps that are left, in ticks"""
    swept: np.uint64
    """all ones where bodies collide by what they sweep, else 0"""


def place_of(percept: Percept, limit: int) -> Place:
    """Where and when it is decided; `limit`: steps that are left, in ticks."""
    road = percept.road
    edges = _edges(road.columns, road.rows)
    swept = _ALL if percept.swept else np.uint64(0)
    return Place(percept.ego, road.columns, road.rows, *edges, percept.episode_tick, limit, swept)


@lru_cache(maxsize=64)
def charges_of(weights: Weights) -> NDArray[np.int64]:
    """The charges (7; int64), in the order of `TICK`."""
    row = (
        weights.tick,
        weights.sideways,
        weights.diagonal,
        weights.stay,
        weights.fixed,
        weights.mover,
        weights.buffer,
    )
    charges = np.array(row, np.int64)
    charges.setflags(write=False)
    return charges
