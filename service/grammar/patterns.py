"""The notation phrases are written in, and its expansion into plain word lists.

`add [in], (take|get) rid of, lane {n}` is three phrases: `[..]` may be left out, `(a|b)` is one or the
other, `{n}` stands for a whole number, `{x}` for any number, `{nth}` for an ordinal, `{id}` for the id of a
thing, `<name>` for a named list of phrases (a macro), `take ... away` for two parts with other words between.
Commas separate phrases.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

Words = tuple[str, ...]

NUMBER = "{n}"
DECIMAL = "{x}"
ORDINAL = "{nth}"
ID = "{id}"
GAP = "..."

_PIECE = re.compile(r"<[^>\s]+>|\{[a-z]+\}|\.\.\.|[\[\]()|,]|[^\s\[\]()|,<>{}]+")


class PatternError(ValueError):
    """A phrase that cannot be read, with the phrase."""


def expand(pattern: str, macros: Mapping[str, tuple[Words, ...]]) -> list[Words]:
    """All word lists a comma-separated pattern stands for, in the order written. Raises `PatternError`."""
    if not any(mark in pattern for mark in "[]()<{"):
        return [tuple(phrase.split()) for phrase in pattern.split(",") if phrase.strip()]
    pieces = _PIECE.findall(pattern)
    phrases, at = _alternatives(pieces, 0, macros, ",")
    if at != len(pieces):
        raise PatternError(f"unbalanced brackets in {pattern!r}")
    return [phrase for phrase in phrases if phrase]


def _alternatives(
    pieces: list[str], at: int, macros: Mapping[str, tuple[Words, ...]], separator: str
) -> tuple[list[Words], int]:
    """The phrases of one bracket level; returns them and the index of what ended it."""
    done: list[Words] = []
    current: list[Words] = [()]
    while at < len(pieces):
        piece = pieces[at]
        if piece in ("]", ")"):
            break
        if piece == separator:
            done.extend(current)
            current = [()]
        elif piece in ("[", "("):
            inner, at = _alternatives(pieces, at + 1, macros, "|")
            closing = "]" if piece == "[" else ")"
            if at >= len(pieces) or pieces[at] != closing:
                raise PatternError(f"{piece!r} is never closed")
            if piece == "[":
                inner = [(), *inner]
            current = [before + after for before in current for after in inner]
        elif piece.startswith("<"):
            inner = _macro(piece[1:-1], macros)
            current = [before + after for before in current for after in inner]
        else:
            current = [(*before, piece) for before in current]
        at += 1
    done.extend(current)
    return done, at


def _macro(name: str, macros: Mapping[str, tuple[Words, ...]]) -> list[Words]:
    if name in macros:
        return list(macros[name])
    if not name.isalnum():
        return [(name,)]
    raise PatternError(f"no macro is called {name!r}")


def read_macros(data: Mapping[str, str]) -> dict[str, tuple[Words, ...]]:
    """Named lists of phrases; a macro may use those above it."""
    macros: dict[str, tuple[Words, ...]] = {}
    for name, pattern in data.items():
        macros[name] = tuple(expand(pattern, macros))
    return macros
