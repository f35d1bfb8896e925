"""Counts lanes from the right: "the two right lanes", "the second lane from the right".

Places count lanes from the left, and how many there are is known by the road alone. The topic says it, so
that what is done holds the numbers that were meant.
"""

from __future__ import annotations

from typing import Any

from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.topic import Topic

FROM_RIGHT = "place.from_right"
"""Concept of such places; its value is the `lane`, 1 = rightmost, or how many `lanes`."""

PLACE = "place"


def resolve_lanes_from_right(lattice: Lattice, topic: Topic) -> None:
    """Makes places of lanes that are counted from the right. What the road does not have is no place."""
    if FROM_RIGHT not in lattice.concepts:
        return
    lattice.concepts.discard(FROM_RIGHT)
    for at, starting in enumerate(lattice.edges):
        if not any(edge.concept == FROM_RIGHT for edge in starting):
            continue
        kept = [edge for edge in starting if edge.concept != FROM_RIGHT]
        for edge in starting:
            if edge.concept == FROM_RIGHT and (where := _from_left(edge.sense.value, topic.columns)):
                kept.append(Edge(at, edge.end, Sense(PLACE, where)))
                lattice.concepts.add(PLACE)
        lattice.edges[at] = kept


def _from_left(value: dict[str, int], columns: int) -> dict[str, Any] | None:
    """The same lanes, 1 = leftmost; None where the road has too few."""
    if "lane" in value:
        lane = columns + 1 - value["lane"]
        return {"lane": lane} if 1 <= lane <= columns else None
    first = columns + 1 - value["lanes"]
    return {"lanes": [first, columns]} if 1 <= first <= columns else None
