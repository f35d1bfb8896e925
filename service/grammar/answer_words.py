"""The words of `answers.yaml`: how a question is answered, and how a sentence leans on the one before.

They are kept apart from the lexicon, since "yes" or "the second one" mean nothing in a request.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from service.grammar.lexicon import Lexicon
from service.grammar.numbers import Found
from service.grammar.tokens import Token

WHOLE = "whole"
"""Concept of what is an answer by itself; its value says which."""

NUMBER = "number"
"""Concept of the number of a choice: "the second one"."""

BEFORE = "before"
AFTER = "after"
"""Concepts of words around an answer that say nothing: "I mean", "please"."""

FOLLOWS = "follows"
"""Concept of the beginnings of a sentence that leans on the one before: "and", "what about"."""

CORRECTS = "corrects"
"""Concept of the beginnings of a sentence that corrects the one before: "I said", "make it"."""

TOTAL = "total"
"""Concept of the beginnings after which a number is how many there shall be: "make it twelve"."""

SETTING = "setting"
"""Concept of words that stand for the setting spoken of last: "it"."""

OF_SETTING = "of_setting"
"""Concept of sentences about that setting; their value is the sentence with its name: "a bit more"."""

TO_VALUE = "to_value"
"""Concept of the beginnings before another value of it; the sentence to read likewise: "back to"."""

SO_MUCH = "so_much"
"""Concept of numbers by which it is changed: "one more"; their value is `{up: n}` or `{down: n}`."""

CHOOSES = "chooses"
"""Concept of the beginnings with which one of what an answer listed is chosen: "use"."""

OF_THINGS = "of_things"
"""Concept of sentences about the kind of thing spoken of; what to read instead: "how many are left?"."""

COUNTED = "counted"
"""Concept of such sentences with a number; which of `counted_things` it is, and the number."""

NOUN = "noun"
"""Concept of words that stand for a noun; the nouns to read instead: "the ones on the left"."""

OF_THEM = "of_them"
"""Concept of words for all the things spoken of; what to read instead: "half of them"."""

ALL_OF_THEM = "all_of_them"
"""Concept of those of them that are all, and not some: "them"."""

ENDING_NOUN = "ending_noun"
"""Concept of endings after which a noun is left out: "all but the nearest"."""

PREFACE = "preface"
"""Concept of reasons before a request, and what it does not do then: "too many, remove half"."""

TWO = "two"
"""Concept of what is done to two things, each of which is to be named: "swap them"."""

ASKS_AGAIN = "asks_again"
"""Concept of what asks the last question again: "and now?"."""

REWORDED = "reworded"
"""Concept of how a replacement may begin; the beginning to read instead: "make them" cones."""

TIMES = "times"
"""Concept of what does the last request again so many times; the number: "twice more"."""

MORE_TICKS = "more_ticks"
"""Concept of what takes so many more steps of time; the number: "three more"."""

STILL = "still"
"""Concept of endings that a comparison may have: "a bit harder still"."""

GOING_ON = "going_on"
"""Concept of words by which a change goes on with the last one: "still"."""

MUCH_MORE = "much_more"
"""Concept of what asks for the last goal once more, and to which degree: "a bit more"."""

VIEW_SAID = "view_said"
"""Concept of words that stand for the view spoken of last: "hide it"."""

TOO = "too"
"""Concept of what may end a sentence that leans on the one before: "as well"."""

INSTEAD = "instead"
"""Concept of what makes the last request another one: "in lane 5 instead"."""

THIS_MOMENT = "this_moment"
"""Concept of words for the moment that is looked at: "here", "at this tick"."""

YES, NO, NEITHER, DROP, LAST, WHICH = "yes", "no", "neither", "drop", "last", "which"


@dataclass(frozen=True, slots=True)
class Answers:
    """The words around questions and answers in one language."""

    phrases: Lexicon
    replaces: str
    """words between a sentence and what stands in the place of a part of it: "I mean" """
    no_such_choice: str
    """what is said where a choice is answered that there is none of"""
    setting_asked: str = ""
    """a question for a setting that is only named: "and the courtesy?" """
    setting_named: str = "{setting}"
    """a setting as a sentence names it: "the courtesy" """
    incomplete: tuple[Mapping[str, Any], ...] = ()
    """questions about requests that lack something (`ask`), and how each may be completed (`with`)"""
    counted_things: Mapping[str, str] = field(default_factory=dict)
    """sentences with a number of things (`{count}`, `{one}`, `{many}`), by what they are for"""
    one_after: tuple[str, ...] = ()
    """ways to complete what points at a thing without a noun (`{said}`): "the third" """
    denies: frozenset[str] = frozenset()
    """words before what was not meant: "five, not three" """
    continues: Mapping[str, str] = field(default_factory=dict)
    """by kind of request, the sentence that says another without its verb (`{said}`)"""
    shall: str = ""
    """the question whether what an answer listed is to be done"""
    completes: tuple[str, ...] = ()
    """words between a request that lacks something and what completes it: " to" """
    places: frozenset[str] = frozenset()
    """words that a place said alone may begin with: "in lane 4" """

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Answers:
        """The words of `answers.yaml`; empty for a language without that file."""
        phrases = Lexicon({})
        phrases.add_section(data.get("phrases", {}))
        return cls(
            phrases,
            data.get("replaces", ""),
            data.get("no_such_choice", ""),
            data.get("setting_asked", ""),
            data.get("setting_named", "{setting}"),
            tuple(data.get("incomplete", ())),
            data.get("counted_things", {}),
            tuple(data.get("one_after", ())),
            frozenset(data.get("denies", ())),
            data.get("continues", {}),
            data.get("shall", ""),
            tuple(data.get("completes", ())),
            frozenset(data.get("places", ())),
        )

    def whole(
        self, tokens: Sequence[Token], numbers: Mapping[int, Found], ordinals: Mapping[int, int]
    ) -> str | int | None:
        """What all of some tokens answer: a word of an answer, the number of a choice, or None."""
        for end, senses, _ in self.phrases.matches(tokens, 0, numbers, ordinals) if tokens else ():
            for sense in senses:
                if end == len(tokens) and sense.concept in (WHOLE, NUMBER):
                    return sense.value  # type: ignore[no-any-return]
        return None

    def meant(
        self, tokens: Sequence[Token], concept: str, numbers: Mapping[int, Found] | None = None
    ) -> Any | None:
        """The value of a concept that all of some tokens are a phrase of; None where they are not."""
        for end, senses, _ in self.phrases.matches(tokens, 0, numbers or {}, {}) if tokens else ():
            for sense in senses:
                if end == len(tokens) and sense.concept == concept:
                    return sense.value
        return None

    def longest(self, tokens: Sequence[Token], start: int, concept: str) -> tuple[int, Any]:
        """The end and the value of the longest phrase of a concept from a token on; (start, None) without."""
        found: tuple[int, Any] = (start, None)
        for end, senses, _ in self.phrases.matches(tokens, start, {}, {}):
            for sense in senses:
                if sense.concept == concept and end > found[0]:
                    found = end, sense.value
        return found

    def beginning(
        self, tokens: Sequence[Token], concept: str, numbers: Mapping[int, Found] | None = None
    ) -> int:
        """How many tokens at the beginning are a phrase of a concept, at most."""
        found = self.phrases.matches(tokens, 0, numbers or {}, {}) if tokens else ()
        return max((end for end, senses, _ in found if any(s.concept == concept for s in senses)), default=0)

    def ending(self, tokens: Sequence[Token], concept: str) -> int:
        """How many tokens at the end are a phrase of a concept, at most."""
        for start in range(len(tokens)):
            for end, senses, _ in self.phrases.matches(tokens, start, {}, {}):
                if end == len(tokens) and any(sense.concept == concept for sense in senses):
                    return end - start
        return 0
