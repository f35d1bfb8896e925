"""Puts the requests of an utterance in the order in which they shall be done: "reset, but save it first".

Words of order ("first", "beforehand") at a later request put it before the ones that stand before it.
Where it cannot be told how far back, both orders are offered.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from service.grammar.clause import Clause
from service.grammar.composition import asks
from service.grammar.fragments import BUT, PAUSE, STOP, THEN
from service.grammar.free_text import ORDER
from service.grammar.lattice import Edge, Lattice

BEFOREHAND = "beforehand"
"""Value of those that say nothing else; the others may also begin a list: "first … then …"."""


def orders(clauses: Sequence[Clause], lattice: Lattice) -> list[list[Clause]]:
    """The orders that may be meant, the likeliest first; one of them where nothing says otherwise.

    None where something shall be done before nothing: "before that, turn left".
    """
    said = list(clauses)
    if ORDER not in lattice.concepts:
        return [said]
    first = said[0].end if len(said) == 1 else said[0].start
    slots = [(edge.start, edge.end) for edge in said[0].filled.slots]
    if any(_is_beforehand(edge, slots) for edge in lattice.between(0, first)):
        return []
    for at in range(len(said) - 1, 0, -1):
        word = _word(said[at], lattice)
        if word is None or _in_a_list(said, at, word):
            continue
        first, last = _group(said, at, word)
        if not first:
            continue
        begins = _begins(said, first)
        found = [_moved(said, begin, first, last) for begin in begins]
        if len(found) > 1:
            return found
        sure = said[first].after == BUT or (begins[0] + 1 == first and said[first].after != STOP)
        return found if sure or (word.sense.value == BEFOREHAND and first == at) else [*found, said]
    return [said]


def _is_beforehand(edge: Edge, slots: Sequence[tuple[int, int]]) -> bool:
    """Whether an edge says that something comes before, and is no part of what is said."""
    inside = any(start < edge.end and edge.start < end for start, end in slots)
    return edge.concept == ORDER and edge.sense.value == BEFOREHAND and not inside


def _begins(clauses: Sequence[Clause], first: int) -> list[int]:
    """Before which requests that at `first` may be put.

    A full stop and a question bound how far back that is; where only "then" does, it is not known.
    """
    known = [0]
    for at in range(first - 1, 0, -1):
        if clauses[at].after == STOP or asks(clauses[at - 1].actions):
            known = [at]
            break
        if clauses[at].after == THEN and known == [0]:
            known = [at, 0]
    return known


def _moved(clauses: Sequence[Clause], begin: int, first: int, last: int) -> list[Clause]:
    """The requests with those of `[first, last)` put before that at `begin`."""
    put_first = replace(clauses[first], after=clauses[begin].after if begin else PAUSE)
    put_back = replace(clauses[begin], after=THEN)
    moved = [put_first, *clauses[first + 1 : last]]
    return [*clauses[:begin], *moved, put_back, *clauses[begin + 1 : first], *clauses[last:]]


def _word(clause: Clause, lattice: Lattice) -> Edge | None:
    """The word of order in a clause that no part of the request is made of."""
    slots = [(edge.start, edge.end) for edge in clause.filled.slots]
    return next(
        (
            edge
            for edge in lattice.between(clause.start, clause.end)
            if edge.concept == ORDER
            and not any(start < edge.end and edge.start < end for start, end in slots)
        ),
        None,
    )


def _in_a_list(clauses: Sequence[Clause], at: int, word: Edge) -> bool:
    """Whether "first" begins what goes on with "then", or comes after it; not in "pause first, then …"."""
    slots = [edge.end for edge in clauses[at].filled.slots if edge.start < edge.end]
    if at and slots and max(slots) <= word.start and clauses[at].after != THEN:
        return False
    if word.sense.value == BEFOREHAND or clauses[at].after == BUT:
        return False
    return clauses[at].after == THEN or any(later.after == THEN for later in clauses[at + 1 :])


def _group(clauses: Sequence[Clause], at: int, word: Edge) -> tuple[int, int]:
    """The requests `[first, last)` that a word of order at one of them puts before the rest."""
    clause = clauses[at]
    begins = all(edge.start > word.start for edge in clause.filled.slots if edge.start < edge.end)
    first, last = at, at + 1
    if begins:
        while last < len(clauses) and clauses[last].after not in (THEN, STOP, BUT):
            last += 1
    else:
        while first and clauses[first].after not in (BUT, STOP, THEN):
            first -= 1
        if not first:  # no word tells it from the rest: "add a cone and pause first"
            first = at
    return first, last
