"""Patterns of whole clauses, matched where they stand: "[when] (it|you) (crash|crashes)".

The notation is that of `patterns`, but nothing is expanded: a clause has so many forms that the list of them
would be long. `{n}` is a whole number, `{x}` any number, `{nth}` an ordinal, `{metres}` and `{seconds}`
numbers with a unit, `{kind}` and `{kinds}` the words for one thing of a kind and for many.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from service.grammar.numbers import Found
from service.grammar.patterns import PatternError
from service.grammar.tokens import Token

Slots: TypeAlias = Mapping[str, Any]
Piece: TypeAlias = "str | Slot | Choice | Macro"
Way: TypeAlias = "tuple[Piece, ...]"

_PIECE = re.compile(r"<[^>\s]+>|\{[a-z]+\}|[\[\]()|,]|[^\s\[\]()|,<>{}]+")
_NO_SLOTS: Slots = {}


@dataclass(frozen=True, slots=True)
class Slot:
    """A place for a value, by its name."""

    name: str


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several ways."""

    ways: tuple[Way, ...]


@dataclass(frozen=True, slots=True)
class Macro:
    """A named list of ways."""

    name: str


@dataclass(frozen=True, slots=True)
class Sentence:
    """The tokens of a text, with the numbers in it by their places."""

    tokens: Sequence[Token]
    numbers: Mapping[int, Found]
    ordinals: Mapping[int, int]


class Patterns:
    """The macros, units and kinds of a language, and the patterns that are made of them."""

    def __init__(
        self,
        macros: Mapping[str, str],
        units: Mapping[str, Mapping[str, float]],
        kinds: Mapping[str, Mapping[str, str]],
        texts: frozenset[str] = frozenset(),
    ) -> None:
        """`units`: by slot, words and what each is in the slot's unit; `kinds`: by slot and kind, words.

        `texts`: slots for any words; their value is the stretch of tokens `(start, end)`.
        """
        self._texts = texts
        self.words: set[str] = set()
        self._macros = {name: self.read(text) for name, text in macros.items()}
        self._units = {
            slot: [(self.read(words), float(size)) for words, size in sizes.items()]
            for slot, sizes in units.items()
        }
        self._kinds = {
            slot: [(self.read(words), kind) for kind, words in by_kind.items()]
            for slot, by_kind in kinds.items()
        }

    def read(self, text: str) -> Choice:
        """A pattern, of ways with commas between them. Raises `PatternError`."""
        pieces = _PIECE.findall(str(text))
        ways, at = self._ways(pieces, 0, ",")
        if at != len(pieces):
            raise PatternError(f"unbalanced brackets in {text!r}")
        return Choice(ways)

    def matches(self, pattern: Choice, said: Sentence, at: int) -> Iterator[tuple[int, Slots]]:
        """The ends of all stretches from token `at` that a pattern fits, with the values of its slots."""
        for way in pattern.ways:
            yield from self._way(way, 0, said, at, _NO_SLOTS)

    def openings(self, pattern: Choice) -> frozenset[str]:
        """The words and slots (as `{name}`) that a pattern may begin with."""
        return frozenset(word for way in pattern.ways for word in self._first(way))

    def _first(self, way: Way) -> Iterator[str]:
        for piece in way:
            if isinstance(piece, str):
                yield piece
                return
            if isinstance(piece, Slot):
                yield from self._first_of_slot(piece.name)
                return
            inner = self._macros[piece.name] if isinstance(piece, Macro) else piece
            for each in inner.ways:
                yield from self._first(each)
            if all(inner.ways):
                return

    def _first_of_slot(self, name: str) -> Iterator[str]:
        if name not in self._kinds:
            yield "{}"
            return
        for words, _ in self._kinds[name]:
            yield from self.openings(words)

    def _ways(self, pieces: list[str], at: int, separator: str) -> tuple[tuple[Way, ...], int]:
        ways: list[Way] = []
        way: list[Piece] = []
        while at < len(pieces) and pieces[at] not in ("]", ")"):
            piece = pieces[at]
            if piece == separator:
                ways.append(tuple(way))
                way = []
            elif piece in ("[", "("):
                inner, at = self._ways(pieces, at + 1, "|")
                if at >= len(pieces) or pieces[at] != ("]" if piece == "[" else ")"):
                    raise PatternError(f"{piece!r} is never closed")
                way.append(Choice(((), *inner) if piece == "[" else inner))
            elif piece[0] == "<" and piece[1:-1].isidentifier():
                way.append(Macro(piece[1:-1]))
            elif piece[0] == "{":
                way.append(Slot(piece[1:-1]))
            else:
                word = piece[1:-1] if piece[0] == "<" else piece
                self.words.add(word)
                way.append(word)
            at += 1
        return (*ways, tuple(way)), at

    def _way(
        self, way: Way, piece: int, said: Sentence, at: int, slots: Slots
    ) -> Iterator[tuple[int, Slots]]:
        if piece == len(way):
            yield at, slots
            return
        for end, found in self._piece(way[piece], said, at, slots):
            yield from self._way(way, piece + 1, said, end, found)

    def _piece(self, piece: Piece, said: Sentence, at: int, slots: Slots) -> Iterator[tuple[int, Slots]]:
        if isinstance(piece, str):
            if at < len(said.tokens) and said.tokens[at].text == piece:
                yield at + 1, slots
        elif isinstance(piece, Slot):
            for end, value in self._slot(piece.name, said, at):
                yield end, {**slots, piece.name: value}
        else:
            inner = self._macros[piece.name] if isinstance(piece, Macro) else piece
            for way in inner.ways:
                yield from self._way(way, 0, said, at, slots)

    def _slot(self, name: str, said: Sentence, at: int) -> Iterator[tuple[int, Any]]:
        if name in self._kinds:
            for words, kind in self._kinds[name]:
                for end, _ in self.matches(words, said, at):
                    yield end, kind
            return
        if name in self._texts:
            yield from ((end, (at, end)) for end in range(at + 1, len(said.tokens) + 1))
            return
        if name == "nth":
            if at in said.ordinals:
                yield at + 1, said.ordinals[at]
            return
        number = said.numbers.get(at)
        if number is None or number.value < 0:
            return
        if name == "x" or (name == "n" and isinstance(number.value, int)):
            yield number.end, number.value
        for words, size in self._units.get(name, ()):
            for end, _ in self.matches(words, said, number.end):
                yield end, round(number.value * size, 9)
