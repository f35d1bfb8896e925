"""Reads rules: "every 10 ticks add a car", "pause when something is closer than 10 m", "forget all rules".

A rule is a request with a condition at its beginning or end, both of which are read whole: what stands
beside the condition is a sentence that means actions a rule can do. It is tried where a sentence is refused
otherwise, so that no sentence loses a meaning. Where a sentence may be several rules, it is asked about.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from service.actions import Action
from service.grammar.accounting import WHOLE
from service.grammar.clause_patterns import Sentence
from service.grammar.parse_types import Ambiguous, Choice, Correction, Parse, Refused, Understood
from service.grammar.repetition import MAX_REPEATED, parts_of
from service.grammar.rule_making import Readings
from service.grammar.rule_reading import RuleReading
from service.grammar.rule_words import RuleWords
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token, normalise, tokenise, with_text
from service.grammar.topic import Topic
from service.grammar.typos import Typos
from service.grammar.work_budget import BudgetExceededError, WorkBudget

if TYPE_CHECKING:
    from service.grammar.engine import Language


class RuleReader:
    """Reads the rules of one language."""

    def __init__(self, language: Language, words: RuleWords) -> None:
        self._language = language
        self._words = words

    @cached_property
    def _typos(self) -> Typos:
        numbers = self._language.data.numbers.words()
        known = self._language.data.lexicon.words | numbers | self._words.patterns.words
        return Typos(self._language.data.typos, known, numbers, lambda one, other: one == other)

    def read(self, text: str, topic: Topic, work: WorkBudget) -> Parse | None:
        """What a sentence with rules means, or which of several is meant; None for any other."""
        plain = normalise(text)
        tokens = tokenise(plain, self._language.data.contractions)
        if not tokens or not self._words.begins:
            return None
        corrections = []
        for at, token in enumerate(tokens):
            if (meant := self._meant(token.text)) is not None:
                corrections.append(Correction(plain[token.start : token.end], meant))
                tokens[at] = with_text(token, meant)
        if self._words.begins.isdisjoint(token.text for token in tokens):
            return None
        if self._has_words_for_others(tokens):
            return None
        numbers = self._language.data.numbers
        said = Sentence(
            tokens,
            {at: found for at in range(len(tokens)) if (found := numbers.read(tokens, at)) is not None},
            {at: nth for at, token in enumerate(tokens) if (nth := numbers.ordinal(token)) is not None},
        )
        if self._words.is_vague(said) or self._words.asks_about_driving(said):
            return None
        reading = RuleReading(self._language, self._words, plain, said, topic, work)
        try:
            readings = reading.all()
        except BudgetExceededError:
            return None
        if len(readings) == 1:
            return Understood(text, readings[0], tuple(corrections))
        if not readings and reading.too_often:
            message = self._language.data.messages["too_often"].format(most=MAX_REPEATED)
            return Refused(text, "not_understood", message)
        return self._which(text, readings)

    def _has_words_for_others(self, tokens: Sequence[Token]) -> bool:
        """Whether there are words that no rule has a use for, and that turn what it says: "instead of"."""
        return any(
            edge.concept == WHOLE
            and self._words.begins.isdisjoint(token.text for token in tokens[edge.start : edge.end])
            for starting in self._language.scan(tokens).edges
            for edge in starting
        )

    def _meant(self, word: str) -> str | None:
        if not word.isalpha() or self._language.data.knows(word) or word in self._words.patterns.words:
            return None
        return self._typos.repair(word)

    def _which(self, text: str, found: Readings) -> Ambiguous | None:
        try:
            choices = tuple(Choice(self._said(actions), actions) for actions in found)
        except Unsayable:
            return None
        return Ambiguous(text, self._language.data.messages["which"], choices) if choices else None

    def _said(self, actions: tuple[Action, ...]) -> str:
        """A sentence that means some actions, which may be one request several times."""
        request, times = parts_of(actions)
        said = self._language.sentence(request)
        if times == 1:
            return said
        return self._language.data.messages["several_times"].format(request=said, times=times)
