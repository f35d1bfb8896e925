"""Follow-ups of a few words ("how?", "since when?", "and the others?"): the last question says what they ask.

Each is a sentence of the grammar, by what was asked last; where that decides nothing, what it may be is
asked back. The words stand in `prompts/questions/<code>/follow_ups.yaml`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from service.actions import Action, Ask
from service.grammar import Language
from service.yaml_files import read_yaml

FILE = "follow_ups.yaml"
ANY = "any"
"""The key of what is asked after any question that has no key of its own."""


@dataclass(frozen=True, slots=True)
class FollowUp:
    """What some words ask after a question."""

    after: Mapping[str, tuple[str, ...]]
    """sentences, the first that can be asked counts: by `about/what` of the last question, or its `about`"""
    choices: tuple[str, ...] = ()
    """what it may be where the last question does not tell"""

    def sentences(self, asked: Ask | None, slots: Mapping[str, str]) -> tuple[str, ...]:
        """What is asked after a question; empty where it does not tell."""
        if asked is None:
            return ()
        keys = (f"{asked.about}/{asked.what}", str(asked.about), ANY)
        found = next((self.after[key] for key in keys if key in self.after), ())
        return tuple(each.format_map(slots) for each in found if _filled(each, slots))


class FollowUps:
    """The follow-ups of one language."""

    def __init__(self, language: Language, folder: Path) -> None:
        """`folder`: of `prompts/questions`. Raises `YamlError` or `OSError` where a file of it is unfit."""
        self._language = language
        self._things: Mapping[str, Mapping[str, str]] = read_yaml(folder / "words.yaml")["things"]
        data: Mapping[str, Any] = read_yaml(folder / FILE)
        self._leads = frozenset(data["leads"])
        self._by_words = {
            self._words(said): each
            for entry in data["follow_ups"]
            for each in (_follow_up(entry),)
            for said in entry["said"]
        }

    def match(self, text: str, asked: Sequence[Action]) -> tuple[tuple[str, ...], bool] | None:
        """The sentences that a text may stand for after a question, and whether the first is meant.

        None for what is no follow-up. `asked`: the last question.
        """
        found = self._by_words.get(self._words(text))
        if found is None:
            return None
        last = asked[-1] if asked and isinstance(asked[-1], Ask) else None
        sentences = found.sentences(last, self._slots(last))
        if sentences:
            return sentences, True
        return (found.choices, False) if found.choices else None

    def _words(self, text: str) -> tuple[str, ...]:
        """The words of a text without marks, and without those that only lead over to it."""
        words = [word for word in self._language.words_of(text) if any(map(str.isalnum, word))]
        while len(words) > 1 and words[0] in self._leads:
            del words[0]
        return tuple(words)

    def _slots(self, asked: Ask | None) -> Mapping[str, str]:
        """The words for the kind of thing that was asked about."""
        kind = None if asked is None else asked.kind or (asked.which.kind if asked.which else None)
        return {} if kind is None else {name: self._things[kind][name] for name in ("this", "nearest")}


def _follow_up(entry: Mapping[str, Any]) -> FollowUp:
    after = {key: tuple(value) for key, value in entry.get("after", {}).items()}
    return FollowUp(after, tuple(entry.get("choices", ())))


def _filled(text: str, slots: Mapping[str, str]) -> bool:
    return "{" not in text or any(f"{{{name}}}" in text for name in slots)
