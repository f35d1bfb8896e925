"""The moves of one decision by cost where other things are seen, by what is kept of two roads.

Of the road as it is seen and of the bare one it is kept what an answer about a road like them takes
(`sim.batch.changed_rows`); the one that is more alike answers.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.batch.backward_dp import BUFFER, FAR, TICK
from sim.batch.changed_rows import moves_of_changed
from sim.batch.kept_base import (
    BRAKED,
    FACTS,
    GOING,
    LEAST,
    SPARE_TICKS,
    STANDING_STILL,
    decide_base,
    keep_costs,
)
from sim.batch.one_decision import decided_totals, made_moves
from sim.batch.percept_words import PerceptWords, Place, charges_of, last_word, place_of
from sim.batch.reachability import VEHICLE
from sim.batch.row_words import make_ready as make_rows_ready
from sim.batch.seen_otherwise import NOTHING, SEEN_AS_IT_IS, see
from sim.compiled_files import ready_mark
from sim.perceive import Percept
from sim.search.compiled_costs import COMPILED, Unlike
from sim.search.costs import Weights
from sim.types import MOVES, Move

WORTH_A_BASE: Final = 4
"""Changes asked for at once from which on it is kept what answers the others."""


def make_ready() -> None:
    """Compile this, or load what was compiled before."""
    planes = np.frombuffer(bytes(7 * 8), np.uint64).reshape(7, 1)
    charges = charges_of(Weights(60, 12, 9, 4, 2, 24, 1, 0))
    place = Place(1, 1, 2, np.uint64(1), np.uint64(1), 0, 2, np.uint64(2**64 - 1))
    parts, chosen = np.zeros((1, 4, 1), np.uint64), np.zeros((1, 1), np.int64)
    moves = np.empty(1, np.uint8)
    made_moves(planes, parts, chosen, *place, 0, charges, moves)
    _Bases(planes, parts, place, charges).write(parts, chosen, moves, nearly_empty=True)
    seen = np.zeros((VEHICLE, 1), np.uint64)
    decided_totals(seen, *place, 0, charges, np.empty(6, np.int64))
    make_rows_ready()
    mark = ready_mark(COMPILED)
    if mark is not None:
        with suppress(OSError):
            mark.touch()


class Parts:
    """Changes of which others are made up, prepared once."""

    def __init__(self, unlike: Sequence[Unlike]) -> None:
        """`unlike`: what each of them changes."""
        self._unlike = unlike
        self._words: dict[PerceptWords, NDArray[np.uint64]] = {}

    def words(self, seen: PerceptWords) -> NDArray[np.uint64]:
        """As words of what is seen."""
        if seen not in self._words:
            self._words[seen] = seen.parts(self._unlike)
        return self._words[seen]


class MoveKernel:
    """The moves that are made where what one vehicle sees is otherwise, each time in another way."""

    def __init__(self, percept: Percept, limit: int) -> None:
        """`limit`: steps that are left, in ticks.

        Precondition: `sim.batch.percept_words.is_compiled_for`, with all charges asked.
        """
        self._percept = percept
        self._place = place_of(percept, limit)
        self._words: dict[int, PerceptWords] = {}
        self._bases: dict[Weights, _Bases] = {}

    def moves(self, unlike: Sequence[Unlike], weights: Weights) -> list[Move]:
        """The move where each of these things is seen otherwise; at least one."""
        bare = self._percept.right | self._percept.left, self._percept.boards.fixed
        most = (bare[0].bit_count() + bare[1].bit_count()) // 2
        empty = any(each.movers.bit_count() + each.fixed.bit_count() > most for each in unlike)
        return self._made(Parts(unlike), np.arange(len(unlike))[:, None], weights, nearly_empty=empty)

    @staticmethod
    def parts(unlike: Sequence[Unlike]) -> Parts:
        """Changes of which others are made up."""
        return Parts(unlike)

    def moves_of(self, parts: Parts, chosen: Sequence[Sequence[int]], weights: Weights) -> list[Move]:
        """The move after each change, by the numbers of its parts (of all changes as many); at least one."""
        return self._made(parts, np.array(chosen, np.int64), weights, nearly_empty=False)

    def _made(
        self, parts: Parts, chosen: NDArray[np.int64], weights: Weights, *, nearly_empty: bool
    ) -> list[Move]:
        """`nearly_empty`: whether some of the roads are more like the bare one."""
        charges = charges_of(weights)
        last = last_word(self._percept, weights.buffer)
        seen = self._words.get(last)
        if seen is None:
            seen = self._words[last] = PerceptWords(self._percept, last)
        moves = np.empty(len(chosen), np.uint8)
        bases = self._bases.get(weights)
        if bases is None and len(chosen) >= WORTH_A_BASE:
            bare = seen.parts([seen.bare])
            bases = self._bases[weights] = _Bases(seen.planes, bare, self._place, charges)
        if bases is None:
            made_moves(seen.planes, parts.words(seen), chosen, *self._place, last, charges, moves)
        else:
            bases.write(parts.words(seen), chosen, moves, nearly_empty=nearly_empty)
        return [MOVES[move] for move in moves.tolist()]


class _Bases:
    """What is kept of the road as it is seen and of the bare one."""

    def __init__(
        self,
        planes: NDArray[np.uint64],
        bare: NDArray[np.uint64],
        place: Place,
        charges: NDArray[np.int64],
    ) -> None:
        """`planes`: as of `PerceptWords`; `bare`: the part that takes all away."""
        self._planes, self._without_all, self._place, self._charges = planes, bare, place, charges
        self._where = *place, planes.shape[1] - 1
        self._as_seen = self._keep(NOTHING, SEEN_AS_IT_IS)
        self._bare: tuple[object, ...] | None = None

    def write(
        self,
        parts: NDArray[np.uint64],
        chosen: NDArray[np.int64],
        moves: NDArray[np.uint8],
        *,
        nearly_empty: bool,
    ) -> None:
        """Write the move after each change; `nearly_empty`: whether the bare road is worth being kept."""
        if nearly_empty and self._bare is None:
            self._bare = self._keep(self._without_all, np.zeros(1, np.int64))
        other = self._bare or self._as_seen
        moves_of_changed(
            self._planes, parts, chosen, *self._where, self._charges, self._as_seen, other, moves
        )

    def _keep(self, parts: NDArray[np.uint64], chosen: NDArray[np.int64]) -> tuple[object, ...]:
        """(what is seen, what is known of it, what is kept as the movers go on, and where one brakes)."""
        seen = np.empty((VEHICLE, self._planes.shape[1]), np.uint64)
        see(seen, self._planes, parts, chosen)
        facts = np.zeros((2, FACTS), np.int64)
        decide_base(seen, *self._where, self._charges, facts)
        going = self._costs(seen, facts[GOING], stands=False)
        if not facts[GOING, BRAKED]:
            return seen, facts, going, going
        return seen, facts, going, self._costs(seen, facts[STANDING_STILL], stands=True)

    def _costs(
        self, seen: NDArray[np.uint64], known: NDArray[np.int64], *, stands: bool
    ) -> tuple[object, ...]:
        """What is kept of a base where there is a way; else nothing."""
        place, columns = self._place, self._place.columns
        rows = place.cell // columns + 1 + max(1, int(self._charges[BUFFER]))
        found = known[LEAST] < FAR
        ticks = min(int(known[LEAST] // self._charges[TICK]) + SPARE_TICKS, place.limit) if found else 0
        kept = (
            np.empty((2, rows), np.int64),
            np.empty((2 * rows, ticks, 3), np.uint64),
            np.empty(2 * rows, np.uint64),
            np.empty((2 * rows, ticks + 1, columns + 2), np.int32),
            np.empty((rows, ticks, columns + 2), np.int32),
        )
        if found:
            edges, last = (place.left_edge, place.right_edge), self._planes.shape[1] - 1
            where = place.cell, columns, place.rows, *edges, place.episode_tick, place.swept, last
            keep_costs(seen, *where, self._charges, kept, stands)
        return kept
