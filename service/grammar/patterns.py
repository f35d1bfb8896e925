"""The notation phrases are written in: read, and expanded into plain word lists.

`add [in], (take|get) rid of, lane {n}` is three phrases: `[..]` may be left out, `(a|b)` is one or the
other, `{n}` stands for a whole number, `{x}` for any number, `{nth}` for an ordinal, `{id}` for the id of a
thing, `<name>` for a named list of phrases (a macro), `take ... away` for two parts with other words between.
Commas separate phrases.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

Words = tuple[str, ...]

NUMBER = "{n}"
DECIMAL = "{x}"
ORDINAL = "{nth}"
ID = "{id}"
GAP = "..."

_PIECE = re.compile(r"<[^>\s]+>|\{[a-z]+\}|\.\.\.|[\[\]()|,]|[^\s\[\]()|,<>{}]+")


class PatternError(ValueError):
    """A phrase that cannot be read, with the phrase."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """Ways of saying something, in the order written; each is a row of words and of patterns."""

    ways: tuple[tuple[str | Pattern, ...], ...]

    def phrases(self) -> Iterator[Words]:
        """All word lists it stands for, in the order written; the empty one as well, if it is among them."""
        for way in self.ways:
            yield from _phrases(way)

    def words(self) -> Iterator[str]:
        """All words and slots in it, some more than once."""
        for way in self.ways:
            for part in way:
                if isinstance(part, str):
                    yield part
                else:
                    yield from part.words()

    def without(self, *, slots: bool = False, gaps: bool = False) -> Pattern:
        """The ways that have no slot for a number, or no gap, in them."""
        kept = []
        for way in self.ways:
            parts = [part if isinstance(part, str) else part.without(slots=slots, gaps=gaps) for part in way]
            if not any(
                not part.ways
                if isinstance(part, Pattern)
                else (slots and is_slot(part)) or (gaps and part == GAP)
                for part in parts
            ):
                kept.append(tuple(parts))
        return Pattern(tuple(kept))

    def has_gap(self) -> bool:
        """Whether one of its phrases is of two parts."""
        return GAP in self.words()

    def may_be_empty(self) -> bool:
        """Whether nothing at all is one of its phrases."""
        return any(
            all(isinstance(part, Pattern) and part.may_be_empty() for part in way) for way in self.ways
        )


def is_slot(word: str) -> bool:
    """Whether a word of a phrase stands for a number, an ordinal or an id."""
    return word.startswith("{")


def _phrases(way: tuple[str | Pattern, ...]) -> Iterator[Words]:
    if not way:
        yield ()
        return
    first, rest = way[0], way[1:]
    for before in [(first,)] if isinstance(first, str) else first.phrases():
        for after in _phrases(rest):
            yield before + after


def read_pattern(text: str, macros: Mapping[str, Pattern]) -> Pattern:
    """The pattern that a comma-separated text writes. Raises `PatternError`."""
    if not any(mark in text for mark in "[]()<{"):
        return Pattern(tuple(tuple(phrase.split()) for phrase in text.split(",") if phrase.strip()))
    pieces = _PIECE.findall(text)
    pattern, at = _alternatives(pieces, 0, macros, ",")
    if at != len(pieces):
        raise PatternError(f"unbalanced brackets in {text!r}")
    return pattern


def expand(text: str, macros: Mapping[str, Pattern]) -> list[Words]:
    """All word lists a comma-separated text stands for, in the order written. Raises `PatternError`."""
    return [phrase for phrase in read_pattern(text, macros).phrases() if phrase]


def _alternatives(
    pieces: list[str], at: int, macros: Mapping[str, Pattern], separator: str
) -> tuple[Pattern, int]:
    """What one bracket level holds; returns it and the index of what ended it."""
    ways: list[tuple[str | Pattern, ...]] = []
    current: list[str | Pattern] = []
    while at < len(pieces):
        piece = pieces[at]
        if piece in ("]", ")"):
            break
        if piece == separator:
            ways.append(tuple(current))
            current = []
        elif piece in ("[", "("):
            inner, at = _alternatives(pieces, at + 1, macros, "|")
            closing = "]" if piece == "[" else ")"
            if at >= len(pieces) or pieces[at] != closing:
                raise PatternError(f"{piece!r} is never closed")
            current.append(Pattern(((), *inner.ways)) if piece == "[" else inner)
        elif piece.startswith("<"):
            current.append(_macro(piece[1:-1], macros))
        else:
            current.append(piece)
        at += 1
    ways.append(tuple(current))
    return Pattern(tuple(ways)), at


def _macro(name: str, macros: Mapping[str, Pattern]) -> str | Pattern:
    if name in macros:
        return macros[name]
    if not name.isalnum():
        return name
    raise PatternError(f"no macro is called {name!r}")


def read_macros(data: Mapping[str, str]) -> dict[str, Pattern]:
    """Named patterns; a macro may use those above it. None of them stands for nothing at all."""
    macros: dict[str, Pattern] = {}
    for name, text in data.items():
        pattern = read_pattern(text, macros)
        macros[name] = Pattern(tuple(expand(text, macros))) if pattern.may_be_empty() else pattern
    return macros
