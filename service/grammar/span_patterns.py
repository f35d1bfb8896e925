"""Finds spans of a sentence with the same pattern: the same kinds of piece in the same order.

A correction replaces such a span: in "two cars, no, three" both are a number. A span can be read in very many
ways (every sense of every word), so the ways are never listed. Two spans are compared by walking both at
once, from all places that one can be at to all places that the other can be at after the same pieces. The
cost grows with the number of edges, not with the number of readings.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import or_

from service.grammar.lattice import GLUE, NUMBER, Lattice
from service.grammar.noun_phrases import QUANTITY
from service.grammar.paths import ALLOWS, SEPARATOR, SPEAKER
from service.grammar.work_budget import WorkBudget

REPAIR = "repair"
"""Concept of words that take back what was just said; their value says when they do."""

MAX_PIECES = 6
"""Pieces of the longest span that a correction replaces; longer ones are requests of their own."""

SKIPPED = frozenset((GLUE, SEPARATOR, ALLOWS, SPEAKER, REPAIR, "interjection", "tag"))
"""Concepts that are no pieces."""

_NOWHERE = (0,) * (MAX_PIECES + 1)

Step = tuple[int, str | None]
"""Where an edge ends, and its family; None for an edge that is no piece."""


def family(concept: str) -> str:
    """The kind of piece a concept is: concepts of one family can replace each other."""
    if concept in (NUMBER, QUANTITY):
        return QUANTITY
    if concept.startswith("noun."):
        return concept.rpartition(".")[0]
    return "v" if concept.startswith("v.") else concept.removesuffix("_bare")


def steps_of(lattice: Lattice) -> list[tuple[Step, ...]]:
    """The different steps from each token."""
    return [
        tuple(
            dict.fromkeys(
                (edge.end, None if edge.concept in SKIPPED else family(edge.concept)) for edge in starting
            )
        )
        for starting in lattice.edges
    ]


def ends_of_pieces(steps: Sequence[Sequence[Step]], start: int, work: WorkBudget) -> set[int]:
    """Where a span from `start` can end that has between one and `MAX_PIECES` pieces."""
    counts = {start: 1}
    """Place → how many pieces may be before it, as bits."""
    for at in range(start, len(steps)):
        here = counts.get(at, 0) & ~(1 << MAX_PIECES)
        if not here:
            continue
        work.spend(len(steps[at]))
        for end, piece in steps[at]:
            counts[end] = counts.get(end, 0) | (here if piece is None else here << 1)
    return {end for end, found in counts.items() if found > 1}


class SpanPattern:
    """All patterns that one span can have, to be looked for elsewhere in the sentence."""

    def __init__(self, steps: Sequence[Sequence[Step]], start: int, end: int, work: WorkBudget) -> None:
        """`steps`: those of the sentence, by token; the stretch is `[start, end)`."""
        self._steps = steps
        self._start, self._end = start, end
        self._work = work
        self._moves: dict[tuple[str, int], int] = {}
        self._closing = 1 << (end - start)
        """Places from which only what is no piece leads to the end, as bits; the end itself."""
        for at in range(end - 1, start - 1, -1):
            if any(piece is None and stop <= end and self._is_closing(stop) for stop, piece in steps[at]):
                self._closing |= 1 << (at - start)

    def _is_closing(self, at: int) -> bool:
        return bool(self._closing >> (at - self._start) & 1)

    def first_match(self, at: int, last: int) -> int | None:
        """The end of the shortest span from `at`, up to `last`, that can have the same pattern; else None."""
        states: dict[int, list[int]] = {at: [1] + [0] * MAX_PIECES}
        """Place → for each number of pieces, where in the stretch the same pieces lead, as bits."""
        for here in range(at, last + 1):
            state = states.pop(here, None)
            if state is None:
                if not states:
                    return None
                continue
            if self._complete(state):
                return here
            if here == last:
                return None
            self._work.spend(len(self._steps[here]))
            for end, piece in self._steps[here]:
                if end > last:
                    continue
                moved = [*state[:MAX_PIECES], 0] if piece is None else self._after(piece, state)
                if any(moved):
                    states[end] = list(map(or_, states.get(end, _NOWHERE), moved))
        return None

    def _complete(self, state: Sequence[int]) -> bool:
        """Whether one of these, with a piece, is the end; after the most pieces nothing may follow."""
        if any(places & self._closing for places in state[1:MAX_PIECES]):
            return True
        return bool(state[MAX_PIECES] >> (self._end - self._start) & 1)

    def _after(self, piece: str, state: Sequence[int]) -> list[int]:
        """Where one more piece leads."""
        return [0, *(self._move(piece, places) if places else 0 for places in state[:MAX_PIECES])]

    def _move(self, piece: str, places: int) -> int:
        """Where a piece leads from any of these places, with what is no piece before it passed over."""
        key = piece, places
        known = self._moves.get(key)
        if known is not None:
            return known
        found = 0
        for at in range(self._end - self._start):
            if not places >> at & 1:
                continue
            self._work.spend(1)
            for stop, other in self._steps[self._start + at]:
                if stop > self._end:
                    continue
                if other is None:
                    places |= 1 << (stop - self._start)
                elif other == piece:
                    found |= 1 << (stop - self._start)
        self._moves[key] = found
        return found
