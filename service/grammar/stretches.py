"""The tokens that a frame is to be found for: their edges, and what the clause before hands on to them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field
from typing import Any

from service.grammar.fragments import PAUSE, STOP
from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount, understood_nouns
from service.grammar.paths import ALLOWS, SEPARATOR, Stretch
from service.grammar.work_budget import WorkBudget

LONGEST_JOINER = 3
"""Tokens of the longest words between two requests, with the mark before them: ". and then"."""

_LENIENT = ("counted", "the_many", "bare_many")

_NEGATED = frozenset({"ing", "negated"})
"""Forms in place in a negated part: "don't go adding anything"."""


@dataclass(frozen=True, slots=True)
class Context:
    """What a clause hands on to the next: its verb, and the thing it was about."""

    verb: tuple[Edge, ...] = ()
    noun: Edge | None = None
    verbless: bool = True
    negated: bool = False
    everything: bool = False
    distant: bool = False
    """Whether it comes from an earlier sentence: then only "two more" and the like may lean on it."""
    placed: bool = False
    """Whether it ended with a place: a number alone after it may be of more things, or of another place."""
    asks: bool = False
    """Whether it is a question."""
    places: Mapping[str, Any] = field(default_factory=dict)
    """By what its places are given, and what they are: "lane", "row"."""


class Stretches:
    """Makes the stretches of one sentence."""

    def __init__(self, lattice: Lattice, vague: int, moods: frozenset[str], work: WorkBudget) -> None:
        """`vague`: how many "a few" are; `moods`: the forms in place in the whole sentence."""
        self._lattice = lattice
        self._vague = vague
        self._moods = moods
        self._work = work
        self._starting = [_start(starting) for starting in lattice.edges]

    def follows_mark(self, at: int) -> bool:
        """Whether a mark stands before a token, or before the words that join it to what was said."""
        return any(
            edge.concept == SEPARATOR and edge.sense.value in (STOP, PAUSE)
            for starting in self._lattice.edges[max(0, at - LONGEST_JOINER) : at]
            for edge in starting
        )

    def make(
        self,
        start: int,
        end: int,
        context: Context | None = None,
        *,
        joined: bool = False,
        negation: bool = False,
    ) -> Stretch:
        """The tokens to be read, with what the context adds to them."""
        context = context or Context()
        edges: dict[int, Sequence[Edge]] = {}
        forms = set(self._moods)
        concepts: set[str] = {edge.sense.concept for edge in context.verb}
        longest = 1
        self._work.spend(end - start)
        for at in range(start, end):
            reach, starting, of = self._starting[at]
            if reach > end:
                starting = [edge for edge in starting if edge[1] <= end]
                of = {edge[2][0] for edge in starting}
            if starting:
                edges[at] = starting
                concepts |= of
                longest = max(longest, reach - at)
        if ALLOWS in concepts:
            for inside in edges.values():
                forms.update([str(edge.sense.value) for edge in inside if edge.sense.concept == ALLOWS])
        if context.noun is not None:
            for edge in understood_nouns(self._lattice, start, end, context.noun, self._vague):
                edges[edge.start] = [*edges.get(edge.start, ()), edge]
                concepts.add(edge.sense.concept)
                longest = max(longest, edge.end - edge.start)
        moods = self._moods | (_NEGATED if context.negated else frozenset())
        forms |= moods
        if context.negated:
            for at, starting in edges.items():
                lenient = [other for edge in starting for other in _lenient(edge)]
                if lenient:
                    edges[at] = [*starting, *lenient]
                    concepts.update([edge.concept for edge in lenient])
        return Stretch(
            start,
            end,
            edges,
            frozenset(concepts),
            frozenset(forms),
            moods,
            context.verb,
            joined,
            negation,
            context.negated,
            self._work,
            longest,
        )


def _start(edges: Sequence[Edge]) -> tuple[int, Sequence[Edge], Set[str]]:
    """How far the edges that start at a token reach, the edges, and their concepts."""
    return max([edge[1] for edge in edges], default=0), edges, {edge[2][0] for edge in edges}


def _lenient(edge: Edge) -> list[Edge]:
    """Any amount may stand for any other in a negated part: "don't add any cars" is about adding."""
    if not isinstance(edge.sense.value, Amount):
        return []
    name = edge.sense.concept.partition(".")[0]
    amount = Amount(edge.sense.value.of, 1)
    return [Edge(edge.start, edge.end, Sense(f"{name}.{form}", amount)) for form in _LENIENT]
