"""The moves of one decision by cost where other things are seen, by what is kept of two roads.

Of the road as it is seen and of the bare one it is kept what an answer about a road like them takes
(`sim.batch.changed_rows`); the one that is more alike answers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import islice
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
from sim.batch.one_decision import made_moves
from sim.batch.percept_words import PerceptWords, Place, charges_of, last_word, place_of, totals_of
from sim.batch.reachability import VEHICLE
from sim.batch.row_words import make_ready as make_rows_ready
from sim.batch.seen_otherwise import NOTHING, SEEN_AS_IT_IS, see
from sim.compiled_files import ready_mark
from sim.config import Config
from sim.perceive import Percept, perceive_truth
from sim.search.compiled_costs import COMPILED, Unlike
from sim.search.costs import Weights, weights
from sim.state import SimState
from sim.types import MOVES, Move

WORTH_A_BASE: Final = 4
"""Changes asked for at once from which on it is kept what answers the others."""


def make_ready() -> None:
    """Compile this, or load what was compiled before."""
    state = SimState.start(Config(rows=5, columns=4, vehicles=0, potholes=0))
    limit, charges = state.config.max_ticks, weights(state.config)
    percept = perceive_truth(state.world, state.config)
    totals_of(percept, charges, limit)
    kernel = MoveKernel(percept, limit)
    for changes in (1, WORTH_A_BASE):
        kernel.moves([Unlike()] * changes, charges)
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

    def moves(self, unlike: Sequence[Unlike], charges: Weights) -> list[Move]:
        """The move where each of these things is seen otherwise; at least one."""
        bare = self._percept.right | self._percept.left, self._percept.boards.fixed
        most = (bare[0].bit_count() + bare[1].bit_count()) // 2
        nearly_empty = any(each.movers.bit_count() + each.fixed.bit_count() > most for each in unlike)
        parts, chosen = Parts(unlike), np.arange(len(unlike))[:, None]
        bases = self._bases_of(charges, len(unlike))
        if bases is None:
            return self._made(parts, chosen, [charges] * len(unlike))
        return bases.moves(parts, chosen, nearly_empty=nearly_empty)

    @staticmethod
    def parts(unlike: Sequence[Unlike]) -> Parts:
        """Changes of which others are made up."""
        return Parts(unlike)

    def moves_of(
        self, parts: Parts, changes: Mapping[Weights, Sequence[Sequence[int]]]
    ) -> dict[Weights, list[Move]]:
        """The moves after changes, by the charges they leave; at least one of each.

        A change is said by the numbers of its parts, all of as many.
        """
        found: dict[Weights, list[Move]] = {}
        few: dict[Weights, Sequence[Sequence[int]]] = {}
        for charges, chosen in changes.items():
            bases = self._bases_of(charges, len(chosen))
            if bases is None:
                few[charges] = chosen
            else:
                found[charges] = bases.moves(parts, np.array(chosen, np.int64), nearly_empty=False)
        if few:
            each = [charges for charges, chosen in few.items() for _ in chosen]
            together = np.array([change for chosen in few.values() for change in chosen], np.int64)
            moves = iter(self._made(parts, together, each))
            found.update((charges, list(islice(moves, len(chosen)))) for charges, chosen in few.items())
        return found

    def _bases_of(self, charges: Weights, changes: int) -> _Bases | None:
        """What is kept for these charges, if that is worth it for so many changes."""
        bases = self._bases.get(charges)
        if bases is None and changes >= WORTH_A_BASE:
            seen = self._words_up_to(last_word(self._percept, charges.buffer))
            bases = self._bases[charges] = _Bases(seen, self._place, charges_of(charges))
        return bases

    def _words_up_to(self, last: int) -> PerceptWords:
        seen = self._words.get(last)
        if seen is None:
            seen = self._words[last] = PerceptWords(self._percept, last)
        return seen

    def _made(self, parts: Parts, chosen: NDArray[np.int64], charges: Sequence[Weights]) -> list[Move]:
        last = last_word(self._percept, max(each.buffer for each in charges))
        seen, rows = self._words_up_to(last), np.array([charges_of(each) for each in charges])
        moves = np.empty(len(chosen), np.uint8)
        made_moves(seen.planes, parts.words(seen), chosen, *self._place, last, rows, moves)
        return [MOVES[move] for move in moves.tolist()]


class _Bases:
    """What is kept of the road as it is seen and of the bare one."""

    def __init__(self, seen: PerceptWords, place: Place, charges: NDArray[np.int64]) -> None:
        self._seen, self._place, self._charges = seen, place, charges
        self._where = *place, seen.planes.shape[1] - 1
        self._as_seen = self._keep(NOTHING, SEEN_AS_IT_IS)
        self._bare: tuple[object, ...] | None = None

    def moves(self, parts: Parts, chosen: NDArray[np.int64], *, nearly_empty: bool) -> list[Move]:
        """The move after each change; `nearly_empty`: whether some roads are more like the bare one."""
        if nearly_empty and self._bare is None:
            self._bare = self._keep(self._seen.parts([self._seen.bare]), np.zeros(1, np.int64))
        bases = self._as_seen, self._bare or self._as_seen
        moves = np.empty(len(chosen), np.uint8)
        words = parts.words(self._seen)
        moves_of_changed(self._seen.planes, words, chosen, *self._where, self._charges, *bases, moves)
        return [MOVES[move] for move in moves.tolist()]

    def _keep(self, parts: NDArray[np.uint64], chosen: NDArray[np.int64]) -> tuple[object, ...]:
        """(what is seen, what is known of it, what is kept as the movers go on, and where one brakes)."""
        seen = np.empty((VEHICLE, self._seen.planes.shape[1]), np.uint64)
        see(seen, self._seen.planes, parts, chosen)
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
            edges, last = (place.left_edge, place.right_edge), self._seen.planes.shape[1] - 1
            where = place.cell, columns, place.rows, *edges, place.episode_tick, place.swept, last
            keep_costs(seen, *where, self._charges, kept, stands)
        return kept
