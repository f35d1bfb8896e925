"""The sentences that a fuzzer starts from: those of a language's frames and test files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from service.actions import dump
from service.actions.table import traits_of
from service.grammar.corpus import sentences
from service.grammar.data import TEST_SUFFIX
from service.grammar.engine import Language
from service.grammar.fragments import INTERJECTION
from service.grammar.free_text import ORDER
from service.grammar.parse_types import Understood
from service.grammar.span_patterns import REPAIR
from service.resources import prompts_folder
from service.yaml_files import read_yaml

DETAIL = "detail"
"""What questions are about that lean on the last explanation."""

_VERBS = ("v.", "want", "there_be", "q.")
"""Beginnings of the concepts of words that say what is to be done or known."""

_ASIDE = frozenset(("q.tell", "q.thing"))
"""Those of words beside a question, some of which stand in requests too: "please", "at", "you"."""


@dataclass(frozen=True, slots=True)
class Saying:
    """A sentence that is understood alone."""

    text: str
    actions: tuple[dict[str, Any], ...]
    is_question: bool
    """whether it only asks"""
    has_verb: bool = True
    """whether a word in it says what is to be done; "two cars" leans on what was said before"""


class Sayings:
    """The sayings of one language, each once, in the order of its files."""

    def __init__(self, language: Language, code: str) -> None:
        self._language = language
        self._code = code

    @cached_property
    def all(self) -> tuple[Saying, ...]:
        """Every saying."""
        texts = dict.fromkeys((*self._of_frames(), *self._of_corpus(), *self._of_test_files()))
        read = (self.read(text) for text in texts)
        return tuple(saying for saying in read if saying is not None)

    @cached_property
    def requests(self) -> tuple[Saying, ...]:
        """Those that do something."""
        return tuple(saying for saying in self.all if not saying.is_question)

    @cached_property
    def joinable(self) -> tuple[Saying, ...]:
        """Those that say nothing about the sentence beside them: no correction, no call ("autopilot, …").

        Words of order are about it, and "why is that?" is about the explanation before. Small talk is none of
        them either: beside a request it is passed over.
        """
        aside = (REPAIR, INTERJECTION, ORDER)
        return tuple(
            saying
            for saying in self.all
            if all(action["do"] != "chat" and action.get("about") != DETAIL for action in saying.actions)
            and not any(each.startswith(aside) for each in self._language.concepts(saying.text))
        )

    def read(self, text: str) -> Saying | None:
        """A sentence and what it means; None where it is not understood as it stands."""
        parsed = self._language.parse(text)
        if not isinstance(parsed, Understood) or parsed.corrections:
            return None
        asks = all(traits_of(action).is_question for action in parsed.actions)
        said = self._language.concepts(text) - _ASIDE
        verb = any(each.startswith(_VERBS) for each in said)
        return Saying(text, tuple(dump(parsed.actions)), asks, verb)

    def _of_frames(self) -> list[str]:
        return [say for frame in self._language.data.frames for say in frame.says]

    def _of_corpus(self) -> list[str]:
        return list(sentences(self._language.sentences)) if self._language.data.sentences else []

    def _of_test_files(self) -> list[str]:
        """The sentences beside the intents; none where the files are not installed."""
        files = sorted((prompts_folder() / "language" / self._code).rglob(f"*{TEST_SUFFIX}"))
        entries = (entry for file in files for entry in read_yaml(file).get("means", ()))
        return [str(text) for entry in entries for text in entry["say"]]
