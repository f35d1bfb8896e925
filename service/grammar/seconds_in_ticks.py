"""Counts seconds in ticks where a sentence steps through time: "go back 5 seconds"."""

from __future__ import annotations

from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import Sense

SECONDS = "seconds"
IN_TICKS = "seconds_in_ticks"
"""Concept of seconds as the nearest whole number of ticks; less than half a tick is none."""
_STEPS = frozenset(("v.step_seconds", "v.rewind"))
"""Concepts of the words that step through time."""


def count_seconds_in_ticks(lattice: Lattice, step_seconds: float) -> None:
    """Adds the ticks that seconds come to, beside the seconds. `step_seconds`: how long a tick is."""
    for at, starting in enumerate(lattice.edges):
        for edge in [each for each in starting if each.concept == SECONDS]:
            ticks = round(float(edge.sense.value) / step_seconds)
            if ticks >= 1:
                lattice.edges[at].insert(0, Edge(edge.start, edge.end, Sense(IN_TICKS, ticks)))
                lattice.concepts.add(IN_TICKS)


def steps_in_seconds(lattice: Lattice) -> bool:
    """Whether a sentence may step through time by seconds."""
    return not _STEPS.isdisjoint(lattice.concepts) and any(edge.concept == SECONDS for edge in lattice.all())
