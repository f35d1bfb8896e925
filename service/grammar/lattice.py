"""Tokens → a lattice: everything that any stretch of a sentence can mean.

Each edge is a stretch of tokens with one sense. Phrases overlap ("in the" and "the left lane", "one tick"
as a command and as an amount); which of them are meant is left to the frames, which look for a path of
edges from end to end. So a phrase that belongs to one kind of request cannot hide another.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from service.grammar.lexicon import SECOND, Lexicon, Match, Node, Sense
from service.grammar.numbers import Found, NumberWords
from service.grammar.patterns import Words
from service.grammar.tokens import Token

GLUE = "glue"
NUMBER = "number"
UNIT = "unit"
NAME = "name"

_new = tuple.__new__
"""Makes a named tuple in a third of the time."""


@dataclass(frozen=True, slots=True)
class Name:
    """Tokens up to `end` that are kept as they were written."""

    end: int
    text: str
    concept: str = NAME


class Edge(NamedTuple):
    """Tokens `[start, end)` in one of their senses. `part` links the two halves of a split phrase.

    A short sentence has dozens, and every stage looks at each: there they are taken apart by position.
    """

    start: int
    end: int
    sense: Sense
    part: Words = ()

    @property
    def concept(self) -> str:
        """The concept of its sense."""
        return self.sense.concept


class Withheld(NamedTuple):
    """Readings that words cannot have beside what stands after them; tokens `[start, end)` are both."""

    start: int
    end: int
    edges: tuple[Edge, ...]


@dataclass(slots=True)
class Lattice:
    """The edges of a sentence by the token they start at, longest first once sorted."""

    size: int
    edges: list[list[Edge]] = field(default_factory=list)
    concepts: set[str] = field(default_factory=set)
    """Every concept that was found in the sentence, before nouns were given their quantities."""
    withheld: list[Withheld] = field(default_factory=list)
    """What was taken out of the edges because of a marker (see `accounting`)."""

    def all(self) -> Iterator[Edge]:
        """Every edge."""
        for starting in self.edges:
            yield from starting

    def between(self, start: int, end: int) -> Iterator[Edge]:
        """The edges inside tokens `[start, end)`."""
        for starting in self.edges[start:end]:
            for edge in starting:
                if edge.end <= end:
                    yield edge

    def keep_whole(self, nouns: Mapping[str, str]) -> None:
        """Let no value be read inside its own noun: the "day" of "time of day" is not the day.

        `nouns` gives for each noun's concept that of its values.
        """
        for outer in [
            edge
            for starting in self.edges
            for edge in starting
            if edge[1] - edge[0] > 1 and edge[2][0] in nouns
        ]:
            for starting in self.edges[outer.start : outer.end]:
                starting[:] = [
                    edge
                    for edge in starting
                    if edge.sense.concept != nouns[outer.concept] or edge.end > outer.end
                ]

    def drop_halves(self) -> None:
        """Drop first halves of split phrases whose second half is nowhere after them: "take", but no "away".

        No path could hold them, and each would be tried.
        """
        last: dict[Words, int] = {}
        for at, starting in enumerate(self.edges):
            for edge in starting:
                if edge[3] and edge[2][0] == SECOND:
                    last[edge[3]] = at
        for starting in self.edges:
            if any(edge[3] for edge in starting):
                starting[:] = [
                    e for e in starting if not e[3] or e[2][0] == SECOND or last.get(e[3], -1) >= e[1]
                ]

    def uncovered(self) -> list[int]:
        """The tokens that no edge contains: words that mean nothing here."""
        unknown: list[int] = []
        covered = 0
        for at, starting in enumerate(self.edges):
            for edge in starting:
                if edge[1] > covered:
                    covered = edge[1]
            if covered <= at:
                unknown.append(at)
        return unknown


class Scanner:
    """Finds all phrases, numbers and measures of a sentence."""

    def __init__(self, lexicon: Lexicon, numbers: NumberWords) -> None:
        self._lexicon = lexicon
        self._numbers = numbers

    def scan(self, tokens: Sequence[Token], names: Mapping[int, Name]) -> Lattice:
        """The lattice of a sentence. `names` gives, by their start, stretches to be kept as written."""
        numbers: dict[int, Found] = {}
        ordinals: dict[int, int] = {}
        for at, token in enumerate(tokens):
            if self._numbers.may_begin(token) and (read := self._numbers.read(tokens, at)) is not None:
                numbers[at] = read
            if (nth := self._numbers.ordinal(token)) is not None:
                ordinals[at] = nth
        lattice = Lattice(len(tokens), [[] for _ in tokens])
        edges, concepts = lattice.edges, lattice.concepts
        plain = [
            None if names else self._lexicon.plain_matches(tokens, at, numbers, ordinals)
            for at in range(len(tokens))
        ]
        other = {
            at: self._lexicon.matches(tokens, at, numbers, ordinals)
            for at, found in enumerate(plain)
            if found is None and at not in names
        }
        ended = _ended(plain, other.values())
        at = 0
        while at < len(tokens):
            if (name := names.get(at)) is not None:
                lattice.edges[at].append(Edge(at, name.end, Sense(name.concept, name.text)))
                at = name.end
                continue
            if (found := plain[at]) is not None:
                for end, node in found:
                    pairs = node.meant.ended_by(ended)
                    edges[at] += [_new(Edge, (at, end, sense, part)) for sense, part in pairs]
                    concepts |= node.meant.concepts
            else:
                for end, senses, part in other[at]:
                    if not any(end > start > at for start in names):
                        edges[at].extend([Edge(at, end, sense, part) for sense in senses])
                        concepts.update([sense.concept for sense in senses])
            if (number := numbers.get(at)) is not None and not _inside_number(numbers, at):
                lattice.edges[at].extend(self._measures(tokens, at, number, numbers, ordinals))
            at += 1
        lattice.drop_halves()
        return lattice

    def _measures(
        self,
        tokens: Sequence[Token],
        at: int,
        number: Found,
        numbers: Mapping[int, Found],
        ordinals: Mapping[int, int],
    ) -> Iterator[Edge]:
        """A number, or with its unit when one follows: "15 m" is the concept `length` and 15."""
        best = Edge(at, number.end, Sense(NUMBER, number.value))
        also: tuple[str, ...] = ()
        if number.end < len(tokens):
            for end, senses, _ in self._lexicon.matches(tokens, number.end, numbers, ordinals):
                for sense in senses:
                    if sense.concept == UNIT and end > best.end:
                        dimension, factor, *more = sense.value
                        also = tuple(more)
                        value = number.value if factor == 1 else round(number.value * factor, 9)
                        best = Edge(at, end, Sense(dimension, value))
        yield best
        for dimension in also:
            yield Edge(at, best.end, Sense(dimension, best.sense.value))


def _ended(
    plain: Sequence[Sequence[tuple[int, Node]] | None], other: Iterable[Sequence[Match]]
) -> frozenset[Words]:
    """The split phrases whose second half stands in a sentence, given all that begins at each token."""
    ended = {part for found in other for _, senses, part in found if part and senses[0].concept == SECOND}
    for found in plain:
        for _, node in found or ():
            ended.update([part for sense, part in node.meant.whole if part])
    return frozenset(ended)


def _inside_number(numbers: Mapping[int, Found], at: int) -> bool:
    """Whether a longer number that starts earlier contains this token: "fifty" of "two hundred and fifty"."""
    return any(start < at < found.end for start, found in numbers.items() if start > at - 8)
