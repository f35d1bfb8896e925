"""What a clause is: one request of a sentence, and what it hands on to the next."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from service.grammar.build import supposed
from service.grammar.composition import asks
from service.grammar.fragments import Fragment
from service.grammar.frames import Filled
from service.grammar.lattice import Edge
from service.grammar.noun_phrases import Amount
from service.grammar.stretches import Context

PLACED = ("place", "side", "length")
EVERYTHING = "everything"


@dataclass(frozen=True, slots=True)
class Clause:
    """A request found in tokens `[start, end)`; no actions when it is negated."""

    start: int
    end: int
    filled: Filled
    actions: list[dict[str, Any]]
    negated: bool = False
    after: str = "pause"
    """the separator before it"""
    leans: bool = False
    """whether it leans on what was said before this sentence"""
    instead: tuple[Clause, ...] = ()
    """what its parts mean alone, where that is another thing: which of them was meant is asked"""
    forbids: tuple[Mapping[str, Any], ...] = ()
    """what a negated part would do otherwise; its amounts may be any"""

    @property
    def supposes(self) -> str | None:
        """What it takes for granted beyond its actions."""
        return supposed(self.filled)


@dataclass(slots=True)
class Divided:
    """The clauses found; `failed` is the first fragment that nothing fits, if any."""

    clauses: list[Clause] = field(default_factory=list)
    failed: Fragment | None = None


def context_after(clause: Clause, before: Context) -> Context:
    """What a clause hands on to the next."""
    frame = clause.filled.frame
    verb = tuple(
        Edge(edge.start, edge.end, edge.sense)
        for edge in clause.filled.slots
        if edge.sense.concept in frame.inherits
    )
    amounts = [edge for edge in clause.filled.slots if isinstance(edge.sense.value, Amount)]
    noun = amounts[-1] if amounts else before.noun
    everything = any(edge.sense.concept == EVERYTHING for edge in clause.filled.slots)
    everything = everything or any(action.get("kind") == EVERYTHING for action in clause.actions)
    last = max(clause.filled.slots, key=lambda edge: edge.end, default=None)
    placed = last is not None and last.concept in PLACED
    return Context(
        verb,
        noun,
        frame.verbless or not frame.inherits,
        clause.negated,
        everything,
        placed=placed,
        asks=asks(clause.actions),
        places=places_of(clause.filled.slots),
    )


def places_of(edges: Iterable[Edge]) -> dict[str, Any]:
    """By what the places among some edges are given ("lane", the concept of any other), and what they are."""
    places: dict[str, Any] = {}
    for edge in edges:
        if edge.concept in PLACED:
            value = edge.sense.value
            places |= value if isinstance(value, dict) else {edge.concept: value}
    return places
