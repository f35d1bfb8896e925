"""Finds what "it" stands for where the same sentence has just named a setting or a view.

"What does courtesy do, and set it to 0.3": a word that stands for one thing is read as what the request
before it was about. Things on the road are not found so: "that cone" may be another one when the first
request is done.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from service.grammar.clause import Clause, Divided
from service.grammar.composition import asks
from service.grammar.lattice import Edge, Lattice
from service.grammar.references import REFERS

WHAT_IF = "what_if"
ONE = "one"
"""Value of words that stand for one thing."""

NAMED = ("param", "view", "term", "asked_about")
"""Concepts of what such a word may stand for."""


SIDES = ("side", "place")
"""Concepts of words for a side, with what it is seen from."""

MOST_BEFORE = 5
"""Tokens before the word in the longest of them."""


def named_before(lattice: Lattice, divided: Divided) -> tuple[Edge, Edge] | None:
    """The word in the part that nothing fits and what it stands for; None where that is not one thing."""
    part = divided.failed
    if part is None or not divided.clauses:
        return None
    if divided.clauses[-1].negated:  # "never the seed, set it to 3"
        return None
    return _named_in(lattice, divided.clauses[-1], part.start, part.end)


def asked_of_it(lattice: Lattice, clauses: Sequence[Clause]) -> tuple[Edge, Edge] | None:
    """The same for a question that is understood by itself: "set courtesy to 0.3, what does it do?".

    What is supposed names itself: in "what is radar? If it were day, …" the word stands for nothing.
    """
    for before, clause in pairwise(clauses):
        if not asks(clause.actions) or any(action.get("about") == WHAT_IF for action in clause.actions):
            continue
        if (found := _named_in(lattice, before, clause.start, clause.end)) is not None:
            return found
    return None


def _named_in(lattice: Lattice, before: Clause, start: int, end: int) -> tuple[Edge, Edge] | None:
    """The word in some tokens that stands for one thing, and what a clause before them names."""
    if REFERS not in lattice.concepts:
        return None
    words = [e for e in lattice.between(start, end) if e.concept == REFERS and e.sense.value == ONE]
    named = [e for e in before.filled.slots if e.concept in NAMED and e.start < e.end]
    if len({word.start for word in words}) != 1 or len(named) != 1:
        return None
    return min(words, key=lambda word: word.end), named[0]


def beside_what_is_named(lattice: Lattice, values: Sequence[Mapping[str, Any]]) -> Edge | None:
    """The words for a side of "it" in a request after one about things: "a car and a cone behind it".

    It is a side of the vehicle, or of what was spoken of before, only because the thing that is named in the
    same sentence is not there yet.
    """
    if REFERS not in lattice.concepts or not any("kind" in value for value in values[:1]):
        return None
    if all(value["do"] == "ask" or "side" not in (value.get("where") or {}) for value in values[1:]):
        return None
    pointing = [e for e in lattice.all() if e.concept == REFERS and _points_at_one(e.sense.value)]
    if len({word.start for word in pointing}) != 1:
        return None  # "a cone in front of it and a car behind it": of what was spoken of before
    for word in pointing:
        for at in range(max(0, word.start - MOST_BEFORE), word.start + 1):
            for edge in lattice.edges[at]:
                its = edge is word and isinstance(word.sense.value, Mapping)
                if edge.end == word.end and (its or (at < word.start and edge.concept in SIDES)):
                    return edge
    return None


def _points_at_one(value: object) -> bool:
    return value == ONE or (isinstance(value, Mapping) and "its" in value)
