"""How long an answer may be that was not asked for in detail."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NamedTuple

MOST_WORDS: Final = 60
"""Words of an answer; what matters least is left out above that. The facts beside it have all."""
FEW_WORDS: Final = 25
"""The same where it was asked for shortly."""


def most_words(length: str | None) -> int:
    """Words of an answer of a length that was asked for: `shorter`, or any other."""
    return FEW_WORDS if length == "shorter" else MOST_WORDS


class Part(NamedTuple):
    """A sentence or a few of an answer; the higher its rank, the sooner it is left out."""

    rank: int
    text: str


def within(parts: Iterable[Part], most: int | None = MOST_WORDS) -> str:
    """The parts in their order, without those of the highest ranks where they are too many words.

    `most` None leaves nothing out. The part of the lowest rank stays in any case.
    """
    told = [part for part in parts if part.text]
    while most is not None and len(told) > 1 and sum(len(part.text.split()) for part in told) > most:
        dropped = max(range(len(told)), key=lambda at: (told[at].rank, at))
        del told[dropped]
    return " ".join(part.text for part in told)
