"""What a parse can be: understood, refused, or asked about. A leaf; nothing here decides anything."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from service.actions import Action

Span: TypeAlias = tuple[int, int]
"""Characters `[start, end)` of a text in its normal form."""

Reason = Literal["not_understood", "negation", "empty", "impossible"]


@dataclass(frozen=True, slots=True)
class Correction:
    """A word that was read as another one, at a distance of one edit."""

    wrote: str
    read: str


@dataclass(frozen=True, slots=True)
class Understood:
    """Every word was accounted for; the actions are in the order they were said."""

    text: str
    actions: tuple[Action, ...]
    corrections: tuple[Correction, ...] = ()
    supposes: tuple[str | None, ...] = ()
    """for each action what it takes for granted beyond its keys, as "why did you crash" does a `crash`; empty
    where none does"""
    alignment: tuple[tuple[Span, ...], ...] = ()
    """for each action the words that made it; empty where one part of the sentence corrects another"""

    def supposed(self, at: int) -> str | None:
        """What the action at a place takes for granted."""
        return self.supposes[at] if self.supposes else None


@dataclass(frozen=True, slots=True)
class Refused:
    """Nothing may be done; what was not understood is named as it was written."""

    text: str
    reason: Reason
    message: str
    unparsed: tuple[str, ...] = ()
    understood: tuple[str, ...] = ()
    suggestions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Choice:
    """One reading of an ambiguous sentence: a sentence that itself parses to these actions."""

    text: str
    actions: tuple[Action, ...]


@dataclass(frozen=True, slots=True)
class Ambiguous:
    """The sentence has more than one sensible reading; nothing may be done before an answer."""

    text: str
    question: str
    choices: tuple[Choice, ...]


Parse: TypeAlias = Understood | Refused | Ambiguous
