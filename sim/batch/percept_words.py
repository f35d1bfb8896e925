"""What a vehicle sees as compiled words, and the decisions by cost that are taken of it (`one_decision`)."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.batch.backward_dp import BUFFER, FAR, TICK
from sim.batch.changed_rows import (
    BRAKED,
    FACTS,
    GOING,
    LEAST,
    SPARE_TICKS,
    STANDING_STILL,
    decide_base,
    keep_costs,
    moves_of_changed,
)
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
WORTH_A_BASE: Final = 4
"""Ways to see, asked for at once, from which on more of the first one is kept to answer the others."""
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
    (seen,) = _Planes(percept, last).seen([Unlike()])
    out = np.empty(6, np.int64)
    place = *_place(percept, limit), last
    lasting = decided_totals(seen, *place, np.array(_row(weights), np.int64), out)
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
        self._bases: dict[Weights, _Bases] = {}

    def moves(self, unlike: Sequence[Unlike], weights: Sequence[Weights]) -> list[Move]:
        """The move where each of these things is seen otherwise, by the charges beside it; at least one."""
        charges = weights[0]
        if all([each == charges for each in weights]):
            bases = self._bases.get(charges)
            if bases is None and len(unlike) >= WORTH_A_BASE:
                row = self._row(charges)
                last = _last_word(self._percept, row[BUFFER])
                bases = _Bases(self._planes_to(last), (*self._place, last), row)
                self._bases[charges] = bases
            if bases is not None:
                return bases.moves(unlike)
        elif len(unlike) >= WORTH_A_BASE:
            return self._moves_by_charges(unlike, weights)
        rows = [self._row(each) for each in weights]
        last = _last_word(self._percept, max([row[BUFFER] for row in rows]))
        seen = self._planes_to(last).seen(unlike)
        moves = np.empty(len(unlike), np.uint8)
        made_moves(seen, *self._place, last, np.array(rows, np.int64), moves)
        return [MOVES[move] for move in moves.tolist()]

    def _moves_by_charges(self, unlike: Sequence[Unlike], weights: Sequence[Weights]) -> list[Move]:
        places: dict[Weights, list[int]] = {}
        for place, charges in enumerate(weights):
            places.setdefault(charges, []).append(place)
        found = {}
        for charges, at in places.items():
            moves = self.moves([unlike[place] for place in at], [charges] * len(at))
            found.update(zip(at, moves, strict=True))
        return [found[place] for place in range(len(unlike))]

    def _planes_to(self, last: int) -> _Planes:
        planes = self._planes.get(last)
        if planes is None:
            planes = self._planes[last] = _Planes(self._percept, last)
        return planes

    def _row(self, weights: Weights) -> tuple[int, ...]:
        row = self._rows.get(weights)
        if row is None:
            row = self._rows[weights] = _row(weights)
        return row


class _Bases:
    """What is kept of the road as it is seen and of the bare one: the one that is more alike answers."""

    def __init__(self, planes: _Planes, place: tuple[object, ...], row: tuple[int, ...]) -> None:
        """`place`: as the kernels take it, the last word included; `row`: the charges."""
        self._planes, self._place, self._charges = planes, place, np.array(row, np.int64)
        self._kept: dict[Unlike, tuple[object, ...]] = {}

    def moves(self, unlike: Sequence[Unlike]) -> list[Move]:
        """The move where each of these things is seen otherwise."""
        bare = self._planes.bare
        nearly = [bare.is_nearly(each) for each in unlike]
        moves = np.empty(len(unlike), np.uint8)
        if not any(nearly):
            self._write(Unlike(), unlike, moves)
        elif all(nearly):
            self._write(bare.unlike, unlike, moves)
        else:
            for base, wanted in ((Unlike(), False), (bare.unlike, True)):
                at = [place for place, each in enumerate(nearly) if each is wanted]
                some = np.empty(len(at), np.uint8)
                self._write(base, [unlike[place] for place in at], some)
                moves[at] = some
        return [MOVES[move] for move in moves.tolist()]

    def _write(self, base: Unlike, unlike: Sequence[Unlike], moves: NDArray[np.uint8]) -> None:
        kept = self._kept.get(base)
        if kept is None:
            kept = self._kept[base] = self._keep(base)
        moves_of_changed(self._planes.seen(unlike), *self._place, self._charges, *kept, moves)

    def _keep(self, base: Unlike) -> tuple[object, ...]:
        (seen,) = self._planes.seen([base])
        facts = np.zeros((2, FACTS), np.int64)
        decide_base(seen, *self._place, self._charges, facts)
        going = self._costs(seen, facts[GOING], stands=False)
        if not facts[GOING, BRAKED]:
            return seen, facts, going, going
        return seen, facts, going, self._costs(seen, facts[STANDING_STILL], stands=True)

    def _costs(self, seen: NDArray[np.uint64], known: NDArray[np.int64], *, stands: bool) -> tuple[object, ...]:
        """What is kept of a base where there is a way; else nothing."""
        cell, columns, *_, limit, _, _ = self._place
        rows = cell // columns + 1 + max(1, int(self._charges[BUFFER]))
        found = known[LEAST] < FAR
        ticks = min(int(known[LEAST] // self._charges[TICK]) + SPARE_TICKS, limit) if found else 0
        kept = (
            np.empty((2, rows), np.int64),
            np.empty((2 * rows, ticks, 3), np.uint64),
            np.empty(2 * rows, np.uint64),
            np.empty((2 * rows, ticks + 1, columns + 2), np.int32),
            np.empty((rows, ticks, columns + 2), np.int32),
        )
        if found:
            keep_costs(seen, *self._place, self._charges, kept, stands)
        return kept


class _Bare(NamedTuple):
    """How the road without anything differs from what is seen."""

    unlike: Unlike
    things: int

    def is_nearly(self, unlike: Unlike) -> bool:
        """Whether more than half of all things are gone."""
        gone = unlike.movers.bit_count() + unlike.fixed.bit_count()
        return 2 * gone > self.things


class _Planes:
    """The boards of what is seen as one number, plane after plane in the order of `NOW_RIGHT`.

    Python changes a long number as quickly as a short one, so a way to see takes few operations.
    """

    def __init__(self, percept: Percept, last: int) -> None:
        """`last`: the last word that matters."""
        columns = percept.road.columns
        self._bits, self._words_of = WORD_BITS // columns * columns, range(last + 1)
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

        gone = Unlike(percept.right | percept.left, boards.fixed)
        self.bare = _Bare(gone, gone.movers.bit_count() + gone.fixed.bit_count())

    def seen(self, unlike: Sequence[Unlike]) -> NDArray[np.uint64]:
        """What is seen each time (ways to see, 7, words)."""
        words = bytearray().join([self._words(each) for each in unlike])
        return np.frombuffer(words, np.uint64).reshape(len(unlike), VEHICLE, len(self._words_of))

    def _words(self, unlike: Unlike) -> bytes:
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
        words = [(board >> word * self._bits & mask) << word * WORD_BITS for word in self._words_of]
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
