"""Finds what "it" stands for where the same sentence has just named a setting or a view.

"What does courtesy do, and set it to 0.3": a word that stands for one thing is read as what the request
before it was about. Things on the road are not found so: "that cone" may be another one when the first
request is done.
"""

from __future__ import annotations

from service.grammar.clause import Divided
from service.grammar.lattice import Edge, Lattice
from service.grammar.references import REFERS

ONE = "one"
"""Value of words that stand for one thing."""

NAMED = ("param", "view", "term", "asked_about")
"""Concepts of what such a word may stand for."""


def named_before(lattice: Lattice, divided: Divided) -> tuple[Edge, Edge] | None:
    """The word in the part that nothing fits and what it stands for; None where that is not one thing."""
    part = divided.failed
    if part is None or not divided.clauses or REFERS not in lattice.concepts:
        return None
    if divided.clauses[-1].negated:  # "never the seed, set it to 3"
        return None
    words = [e for e in lattice.between(part.start, part.end) if e.concept == REFERS and e.sense.value == ONE]
    named = [e for e in divided.clauses[-1].filled.slots if e.concept in NAMED and e.start < e.end]
    if len({word.start for word in words}) != 1 or len(named) != 1:
        return None
    return min(words, key=lambda word: word.end), named[0]
