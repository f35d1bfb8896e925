"""The topic of a conversation: all that a sentence may refer to without naming it.

The engine is a pure function of a sentence and a topic; whoever holds the conversation makes the
topic. An empty one is that of a sentence that stands alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

from pydantic import ValidationError

from service.actions import Action, load
from service.actions.parameters import PhraseParameter, filled
from service.grammar.numbers import Found
from service.grammar.tokens import Token
from sim.actions import Where

Words = tuple[str, ...]
Meant = list[dict[str, Any]]


@dataclass(frozen=True, slots=True)
class TaughtWords:
    """A taught phrase: its words, its actions as JSON values, and the numbers that are said with it."""

    words: Words
    actions: Meant
    parameters: tuple[PhraseParameter, ...] = ()

    def filled(self, numbers: Mapping[str, int | float]) -> Meant | None:
        """The actions with numbers; None where they cannot be so many."""
        if not self.parameters:
            return self.actions
        made = filled(self.actions, self.parameters, numbers)
        try:
            load(made)
        except ValidationError:
            return None
        return made


class FoundPhrase(NamedTuple):
    """A taught phrase in a sentence: the token it ends before, what it means, whether it has numbers.

    It means nothing with a number that is impossible: "wall 0".
    """

    end: int
    actions: Meant | None
    has_numbers: bool


@dataclass(frozen=True, slots=True)
class Phrases:
    """Taught phrases, ready to be found."""

    by_first: Mapping[str, Sequence[TaughtWords]] = field(default_factory=dict)
    number: Callable[[Sequence[Token], int], Found | None] | None = field(default=None, compare=False)
    """the number that begins at a token"""
    tokens: Callable[[str], Sequence[Token]] | None = field(default=None, compare=False)
    """the tokens of a text"""

    def at(self, tokens: Sequence[Token], start: int) -> FoundPhrase | None:
        """The longest phrase that starts at a token."""
        best: FoundPhrase | None = None
        for phrase in self.by_first.get(tokens[start].text, ()):
            found = self._fits(phrase, tokens, start)
            if found is None or (best is not None and found[0] <= best.end):
                continue
            best = FoundPhrase(found[0], phrase.filled(found[1]), bool(phrase.parameters))
        return best

    def with_numbers_in(self, text: str) -> list[FoundPhrase]:
        """The phrases in a text that take numbers."""
        known = (phrase for phrases in self.by_first.values() for phrase in phrases)
        if self.tokens is None or not any(phrase.parameters for phrase in known):
            return []
        tokens = self.tokens(text)
        found = (self.at(tokens, at) for at in range(len(tokens)))
        return [each for each in found if each is not None and each.has_numbers]

    def named_at(self, words: Sequence[str], start: int) -> int | None:
        """The end of the longest phrase that starts at a word, by the names of its parameters."""
        known = (phrase.words for phrase in self.by_first.get(words[start], ()))
        sizes = [len(each) for each in known if tuple(words[start : start + len(each)]) == each]
        return start + max(sizes) if sizes else None

    def _fits(
        self, phrase: TaughtWords, tokens: Sequence[Token], start: int
    ) -> tuple[int, dict[str, int | float]] | None:
        """Where a phrase ends that stands at a token, with the numbers said."""
        names = {each.name.casefold(): each.name for each in phrase.parameters}
        at, numbers = start, dict[str, int | float]()
        for word in phrase.words:
            if at >= len(tokens):
                return None
            if word in names and self.number is not None:
                found = self.number(tokens, at)
                if found is None:
                    return None
                numbers[names[word]], at = found.value, found.end
            elif tokens[at].text == word:
                at += 1
            else:
                return None
        return at, numbers


class Now(Protocol):
    """The road as it is while a sentence is said."""

    def count(self, kind: str) -> int:
        """How many things of a kind there are."""

    def value(self, parameter: str) -> int | float | str | None:
        """The value of a setting; None where it has none that can be set."""


@dataclass(frozen=True, slots=True)
class Topic:
    """What has been spoken of."""

    things: tuple[str, ...] = ()
    """ids of what was last added, moved or told about, still on the road: "it", "them" """
    before: tuple[str, ...] = ()
    """ids of what was spoken of before those: "both" of two that were added one by one """
    added: tuple[str, ...] = ()
    """ids of all that was added by someone and is still there, the latest last: "the last pothole" """
    actions: tuple[Action, ...] = ()
    """what was last done or asked: "again" """
    request: tuple[Action, ...] = ()
    """the same as it was said: a goal or a style, not what it came to"""
    asked: tuple[Action, ...] = ()
    """the last question: "and now?" asks it again"""
    said: str = ""
    """how that was said; empty for typed actions"""
    steps: int = 0
    """how many steps of undo take it back; a correction of a correction takes back both"""
    changed: tuple[Action, ...] = ()
    """the last change that was made, whatever was asked since: "put it back" undoes it"""
    changed_steps: int = 0
    """how many steps of undo take it back; 0 where there is none"""
    steps_before: int = 0
    """the same of the change before the last one; 0 where there is none"""
    away: tuple[int, ...] = ()
    """how many things each of the latest two changes took off the road or moved"""
    named: tuple[str, ...] = ()
    """ids that the last request was about: "the next one" is after them"""
    listed: tuple[str, ...] = ()
    """ids in the order in which they were last told or added: "the second one" """
    batch: tuple[str, ...] = ()
    """those of them that one request added or one answer told, the last that did"""
    gone: frozenset[str] = frozenset()
    """those of them that are no longer on the road"""
    undone: bool = False
    """whether the latest change was an undo: then "again" is to redo it"""
    kind: str | None = None
    """what "two more" is more of"""
    offered: tuple[Action, ...] = ()
    """what choosing each would do, where the last answer listed settings or styles: "the second one" """
    asked_kind: str | None = None
    """the kind of thing that the pending question is about: "remove five" after "too many cars" """
    tick: int | None = None
    """the tick that the last question or its answer named: "since then" """
    looks_back: bool = False
    """whether a past tick is looked at while it is said: "here" is that"""
    others: int = 0
    """how many more of that kind are on the road beside the things spoken of"""
    removed: bool = False
    """whether the latest amount was one taken away"""
    where: Where | None = None
    """where things were last put: "there", "the other lane" """
    phrases: Phrases = field(default_factory=Phrases)
    names: frozenset[str] = frozenset()
    """of moments that were saved, in small letters: "go back to monday" is one of them, or something else"""
    columns: int = 8
    """how many lanes the road has: "the two right lanes" """
    step_seconds: float = 0.5
    """how long a tick is: "go back 5 seconds" """
    now: Now | None = field(default=None, compare=False, repr=False)
    """the road that is spoken of: "double the cars", "make it rain for 10 ticks" """


ALONE = Topic()
"""That of a sentence with nothing before it."""
