"""Finds values that a setting has and shall no longer have: "raise the buffer **from 1** to 3".

Such words say nothing about what is to be set, so frames that set a value take them and drop them. They count
only where the new value follows: in "30 % from now" and "two from lane 3" nothing is changed from one value to
another.
"""

from __future__ import annotations

from service.grammar.lattice import NUMBER, Edge, Lattice
from service.grammar.lexicon import Sense

FROM = "from_mark"
"""Concept of the word before an old value."""

TO = "prep.to"
"""Concept of the word before a new one."""

OLD_VALUE = "old_value"
"""Concept of both words together, which is what frames take."""

_AMOUNTS = frozenset((NUMBER, "length", "speed", "seconds", "fraction", "times", "part_of"))


def add_old_values(lattice: Lattice) -> None:
    """Adds an edge for each value that another value follows. Before noun phrases."""
    if FROM not in lattice.concepts or TO not in lattice.concepts:
        return
    for at, starting in enumerate(lattice.edges):
        found = [
            Edge(at, amount.end, Sense(OLD_VALUE))
            for mark in starting
            if mark.concept == FROM and mark.end < lattice.size
            for amount in lattice.edges[mark.end]
            if (amount.concept in _AMOUNTS or amount.concept.startswith("noun."))
            and amount.end < lattice.size
            and any(edge.concept == TO for edge in lattice.edges[amount.end])
        ]
        if found:
            starting += found
            lattice.concepts.add(OLD_VALUE)
