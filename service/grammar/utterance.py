"""An utterance on its way through the engine: its text, tokens and lattice, and the language it is in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from service.actions import Action
from service.grammar.clause import Divided
from service.grammar.clauses import Divider
from service.grammar.data import LanguageData
from service.grammar.fragments import fragments
from service.grammar.lattice import Lattice
from service.grammar.matching import Frames
from service.grammar.parse_types import (
    Correction,
    Parse,
)
from service.grammar.referents import Unclear
from service.grammar.sentences import Sentences
from service.grammar.suggestions import Suggestions
from service.grammar.tokens import Token
from service.grammar.topic import Topic
from service.grammar.work_budget import WorkBudget


class LanguageReader(Protocol):
    """What a reading takes from its language."""

    data: LanguageData
    frames: Frames
    sentences: Sentences

    @property
    def suggestions(self) -> Suggestions:
        """The sayings that a refusal may offer."""

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """Another sentence read: this one with a choice in the place of what was asked about."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


class Utterance:
    """What all that is done with one utterance shares."""

    def __init__(
        self,
        language: LanguageReader,
        text: str,
        plain: str,
        tokens: list[Token],
        lattice: Lattice,
        corrections: tuple[Correction, ...],
        topic: Topic,
        work: WorkBudget,
    ) -> None:
        self._language = language
        self._topic = topic
        self._work = work
        self._suggests = False
        self._unclear: list[Unclear] = []
        self._messages = language.data.messages
        self._text = text
        self._plain = plain
        self._tokens = tokens
        self._lattice = lattice
        self._corrections = corrections

    def _divide(self, start: int, end: int, moods: frozenset[str]) -> Divided:
        """The clauses of tokens `[start, end)`, with these forms in place."""
        divider = Divider(self._language.frames, self._lattice, self._language.data.vague, moods, self._work)
        return divider.divide(fragments(self._lattice, start, end), None if start else self._topic.kind)

    def _written(self, start: int, end: int) -> str:
        """Tokens `[start, end)` as they stand in the text."""
        if not self._tokens:
            return ""
        first = min(start, len(self._tokens) - 1)
        last = max(min(end, len(self._tokens)) - 1, first)
        return self._plain[self._tokens[first].start : self._tokens[last].end]
