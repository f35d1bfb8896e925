"""Finds values that a setting has and shall no longer have: "raise the buffer **from 1** to 3".

Such words say nothing about what is to be set, so frames that set a value take them and drop them. They count
only where the new value follows: in "30 % from now" and "two from lane 3" nothing goes from one value to
another. A new value that lies on the other side than the verb says ("slow down from 17 to 20") leaves them
without a use.
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

_UP, _DOWN = frozenset(("v.up", "fast")), frozenset(("v.down", "slow", "brakes"))
"""Concepts of words that say on which side of the old value the new one lies."""

_AMOUNTS = frozenset((NUMBER, "length", "speed", "seconds", "fraction", "times", "part_of"))


def add_old_values(lattice: Lattice) -> None:
    """Adds an edge for each value that another value follows. Before noun phrases."""
    if FROM not in lattice.concepts or TO not in lattice.concepts:
        return
    up, down = (not lattice.concepts.isdisjoint(words) for words in (_UP, _DOWN))
    for at, starting in enumerate(lattice.edges):
        found = [
            Edge(at, amount.end, Sense(OLD_VALUE))
            for mark in starting
            if mark.concept == FROM and mark.end < lattice.size
            for amount in lattice.edges[mark.end]
            if (amount.concept in _AMOUNTS or amount.concept.startswith("noun."))
            and amount.end < lattice.size
            and any(
                edge.concept == TO and _goes(amount, lattice, edge.end, up=up, down=down)
                for edge in lattice.edges[amount.end]
            )
        ]
        if found:
            starting += found
            lattice.concepts.add(OLD_VALUE)


def _goes(old: Edge, lattice: Lattice, at: int, *, up: bool, down: bool) -> bool:
    """Whether the value at a token is on the side of the old one that the verb says, if it says one."""
    if up == down or at >= lattice.size or not isinstance(old.sense.value, int | float):
        return True
    new = [
        edge.sense.value
        for edge in lattice.edges[at]
        if edge.concept == old.concept and isinstance(edge.sense.value, int | float)
    ]
    return not new or any(value > old.sense.value if up else value < old.sense.value for value in new)
