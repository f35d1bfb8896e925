"""The kinds of question that can be matched, and the sentences that stand for them: `prompts/questions`."""

from __future__ import annotations

import string
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from service.question_matcher.situations import Situation
from service.question_matcher.slots import Question
from service.yaml_files import read_yaml

_MARKS = {"weather_noun": "weather", "bad_weather": "weather"}
"""The marks of slots that are other words for the same."""
NONE_OF_THEM = "other"
"""The kind of examples that no answer is for."""


@dataclass(frozen=True, slots=True)
class Canonical:
    """A sentence that the grammar understands, with a place for each slot it names."""

    text: str
    slots: frozenset[str]
    """the words that it needs"""
    marks: frozenset[str]
    """the marks of a question that they stand for: all forms of a move are one"""
    names: Mapping[str, str] = field(default_factory=dict)
    """the slots that its own words name, such as the sensor of "does darkness affect the lidar?"; a question
    that names the same is left nothing out of"""

    @classmethod
    def of(cls, text: str, forms: Collection[str] = ()) -> Canonical:
        """From a text such as "why not {going}?"; `forms`: the slots that are forms of a move."""
        slots = frozenset(name for _, name, _, _ in string.Formatter().parse(text) if name)
        marks = (_MARKS.get(slot, "move" if slot in forms else slot) for slot in slots)
        return cls(text, slots, frozenset(marks))

    def shares(self, question: Question) -> frozenset[str]:
        """The slots that a question names as this sentence does."""
        return frozenset(slot for slot, said in self.names.items() if question.slots.get(slot) == said)


@dataclass(frozen=True, slots=True)
class QuestionKind:
    """One kind of question: the sentences that ask it, and the slots that say nothing about it."""

    name: str
    says: tuple[Canonical, ...]
    ignores: frozenset[str] = frozenset()
    when: Situation | None = None
    """the situation in which it is mostly asked"""
    unless: frozenset[str] = frozenset()
    """words that turn it round, such as "not": a question that has one is not of this kind"""
    with_words: tuple[tuple[Canonical, frozenset[str]], ...] = ()
    """sentences that ask it where a question has one of some words: "ghosts" asks for false alarms first"""

    def naming(self, taken_apart: Callable[[str], Question]) -> QuestionKind:
        """The same kind, whose sentences know what their own words name; `taken_apart` finds that."""
        says = (
            each if each.slots else replace(each, names=taken_apart(each.text).slots) for each in self.says
        )
        return replace(self, says=tuple(says))

    def is_turned(self, question: Question) -> bool:
        """Whether a word of a question turns it round, so that it is not of this kind."""
        return not self.unless.isdisjoint(question.words)

    def sentence(self, question: Question) -> str | None:
        """The sentence that uses all binding slots but the ignored ones; None where none does.

        What says only what is so anyway may be left out, if no sentence has room for it.
        """
        if self.is_turned(question):
            return None
        binding = question.binding - self.ignores
        return self._fitting(question, binding) or self._fitting(question, binding - question.restated)

    def _fitting(self, question: Question, binding: frozenset[str]) -> str | None:
        """The sentence that uses all of these slots."""
        by_words = (each for each, words in self.with_words if not words.isdisjoint(question.words))
        fits = (
            each
            for each in (*by_words, *self.says)
            if each.slots <= question.slots.keys() and binding <= each.marks | each.shares(question)
        )
        canonical = next(fits, None)
        return None if canonical is None else canonical.text.format_map(question.slots)

    def offered(self, question: Question) -> str | None:
        """The sentence to ask back with: it may leave slots out, but nothing turns it round."""
        if self.is_turned(question):
            return None
        fits = [each for each in self.says if each.slots <= question.slots.keys()]
        most = max(fits, key=lambda each: len(each.marks & question.binding), default=None)
        return None if most is None else most.text.format_map(question.slots)


def read_kinds(folder: Path) -> dict[str, QuestionKind]:
    """The kinds of a language's folder, by name. Raises `ValueError` for a file that is unfit."""
    data: Mapping[str, Any] = read_yaml(folder / "kinds.yaml")
    moves: Mapping[str, Mapping[str, str]] = read_yaml(folder / "words.yaml")["moves"]
    forms = {form for of_one in moves.values() for form in of_one}
    return {
        name: QuestionKind(
            name,
            tuple(Canonical.of(text, forms) for text in entry["says"]),
            frozenset(entry.get("ignores", ())),
            entry.get("when"),
            frozenset(entry.get("unless", ())),
            tuple(
                (Canonical.of(text, forms), frozenset(words))
                for text, words in entry.get("with_words", {}).items()
            ),
        )
        for name, entry in data.items()
    }
