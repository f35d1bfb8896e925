"""Names the tick that is spoken of where a sentence points back at it: "back then", "at that moment"."""

from __future__ import annotations

from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import Sense

SPOKEN = "spoken_tick"
"""Concept of words for the moment that was spoken of."""
TICK = "tick"


def name_spoken_tick(lattice: Lattice, tick: int | None) -> None:
    """Makes such words that tick; without one they say nothing more than they did."""
    if tick is None or SPOKEN not in lattice.concepts:
        return
    for at, starting in enumerate(lattice.edges):
        spans = {edge.end for edge in starting if edge.concept == SPOKEN}
        if not spans:
            continue
        kept = [edge for edge in starting if edge.end not in spans or edge.concept not in (SPOKEN, "q.thing")]
        lattice.edges[at] = [*(Edge(at, end, Sense(TICK, tick)) for end in sorted(spans)), *kept]
    lattice.concepts.add(TICK)
