"""Reads the answer to a question with choices: "the second one", "yes", "the vehicle", "ten", "never mind".

An answer picks one choice by its number or by words that only this choice has; or it says another amount or
another place than the choices do ("ten", "in lane 3"). Whatever could be two choices is no answer.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

from service.actions import Action
from service.grammar.answer_words import AFTER, BEFORE, LAST, WHICH, YES
from service.grammar.engine import Language
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.numbers import Found
from service.grammar.parse_types import Choice, Understood
from service.grammar.paths import SEPARATOR
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import ALONE
from service.grammar.work_budget import BudgetExceededError, WorkBudget

_SMALL = frozenset((GLUE, SEPARATOR, "interjection", "prep", "determiner"))
_SMALL_ENDINGS = ("_rest", "_word", "_verb")
"""Concepts of words that only some frames put up with, and the endings of such concepts."""

MAX_WORDS = 12
"""Longer utterances are requests of their own."""


class NoChoice(Enum):
    """Answers that choose nothing."""

    DROPPED = "dropped"
    """the question is not to be answered"""
    UNCLEAR = "unclear"
    """it is meant as an answer, and says not which"""


@dataclass(frozen=True, slots=True)
class NoSuchChoice:
    """The number of a choice that there is not."""

    number: int


Answer = tuple[Action, ...] | NoChoice | NoSuchChoice


def read_answer(
    language: Language, text: str, choices: Sequence[Choice], *, literal: bool = False, asked: str = ""
) -> Answer | None:
    """What a text answers to a question with these choices; None where it is no answer.

    `asked`: the sentence that was asked about, which the answer may complete.
    `literal`: the text is also a request of its own, so it picks a choice only with the words of the choice.
    """
    tokens = _without_marks(tokenise(normalise(text), language.data.contractions))
    if not tokens or len(tokens) > MAX_WORDS or not choices:
        return None
    try:
        # A question completes no request.
        literal = literal or text.rstrip().endswith("?")
        return _Answering(language, choices, asked).read(tokens, literal=literal)
    except BudgetExceededError:
        return None


class _Answering:
    """One question, and the language in which it is answered."""

    def __init__(self, language: Language, choices: Sequence[Choice], asked: str) -> None:
        self._language = language
        self._asked = asked
        self._answers = language.data.answers
        self._choices = choices
        self._said = [self._words_and_meanings(choice) for choice in choices]
        self._work = WorkBudget()

    def read(self, tokens: Sequence[Token], *, literal: bool) -> Answer | None:
        """See `read_answer`."""
        for part in self._parts(tokens):
            if (chosen := self._by_words(part, literal=True)) is not None:
                return chosen
        for part in self._parts(tokens):
            whole = self._whole(part)
            if whole is not None:
                return whole
            number = self._language.data.numbers.read(part, 0)
            if number is not None and number.end == len(part):
                return self._amount_or_number(part, number)
        if literal:
            return None
        least = min(self._parts(tokens), key=len)
        for part in (tokens, least):
            if (chosen := self._by_words(part, literal=False)) is not None:
                return chosen
        return self._in_place_of_part(least)

    def _parts(self, tokens: Sequence[Token]) -> Iterator[Sequence[Token]]:
        """The tokens, and then without the words before and after the answer itself."""
        yield tokens
        while tokens:
            before, after = self._answers.beginning(tokens, BEFORE), self._answers.ending(tokens, AFTER)
            shorter = tokens[before : len(tokens) - (0 if before else after)]
            if len(shorter) == len(tokens) or not shorter:
                return
            tokens = shorter
            yield tokens

    def _whole(self, tokens: Sequence[Token]) -> Answer | None:
        """The answer where all of it is one of the words of an answer."""
        data = self._language.data
        numbers = {at: found for at in range(len(tokens)) if (found := data.numbers.read(tokens, at))}
        ordinals = {at: nth for at, token in enumerate(tokens) if (nth := data.numbers.ordinal(token))}
        match self._answers.whole(tokens, numbers, ordinals):
            case None:
                return None
            case int() as number:
                return self._nth(number)
            case answer if answer == YES:
                return self._choices[0].actions if len(self._choices) == 1 else NoChoice.UNCLEAR
            case answer if answer == WHICH:
                return NoChoice.UNCLEAR
            case answer if answer == LAST:
                return self._choices[-1].actions
            case _:
                return NoChoice.DROPPED

    def _nth(self, number: int) -> Answer:
        if 1 <= number <= len(self._choices):
            return self._choices[number - 1].actions
        return NoSuchChoice(number)

    def _amount_or_number(self, tokens: Sequence[Token], number: Found) -> Answer | None:
        """A bare number: an amount where the choices are amounts, else the number of a choice."""
        amount = self._in_place_of_part(tokens)
        if amount is not None:
            return amount
        return self._nth(number.value) if isinstance(number.value, int) else None

    def _words_and_meanings(self, choice: Choice) -> tuple[set[str], set[Hashable]]:
        tokens = tokenise(normalise(choice.text), self._language.data.contractions)
        scan = self._language.scan(tokens)
        meanings = {_meaning(edge) for edge in scan.all() if _says_what(edge)}
        kinds = {getattr(action, "kind", None) for action in choice.actions}
        meanings |= {("noun.thing", repr(kind)) for kind in kinds if kind is not None}
        return {token.text for token in tokens}, meanings

    def _by_words(self, tokens: Sequence[Token], *, literal: bool) -> tuple[Action, ...] | None:
        """The only choice that has all of the words (unless `literal`: or words that mean the same)."""
        scan = None if literal else self._language.scan(tokens)
        fits = [
            choice
            for choice, (words, meanings) in zip(self._choices, self._said, strict=True)
            if all(
                token.text in words or (scan is not None and not _meanings_of(at, scan).isdisjoint(meanings))
                for at, token in enumerate(tokens)
            )
        ]
        return fits[0].actions if tokens and len(fits) == 1 and len(self._choices) > 1 else None

    def _in_place_of_part(self, tokens: Sequence[Token]) -> tuple[Action, ...] | None:
        """The request with the answer in the place of a part of it, where all choices agree on it."""
        replaces = self._answers.replaces
        if not replaces or not tokens:
            return None
        answer = " ".join(token.text for token in tokens)
        if (completed := self._completed(answer)) is not None:
            return completed
        meant: list[tuple[Action, ...]] = []
        for choice in self._choices:
            parsed = self._language.read(
                f"{choice.text}, {replaces} {answer}", ALONE, self._work, asking=False
            )
            if not isinstance(parsed, Understood) or _shape(parsed.actions) != _shape(choice.actions):
                continue
            if parsed.actions not in meant:
                meant.append(parsed.actions)
        return meant[0] if len(meant) == 1 else None

    def _completed(self, answer: str) -> tuple[Action, ...] | None:
        """The sentence that was asked about, completed by the answer to a request like the choices."""
        shapes = [_shape(choice.actions) for choice in self._choices]
        for between in self._answers.completes if self._asked else ():
            parsed = self._language.read(
                f"{self._asked.rstrip(' .?!')}{between} {answer}", ALONE, self._work, asking=False
            )
            if isinstance(parsed, Understood) and _shape(parsed.actions) in shapes:
                return parsed.actions
        return None


def _shape(actions: Sequence[Action]) -> list[object]:
    """What some actions are, aside of amounts and places."""
    return [(each.do, getattr(each, "kind", None), getattr(each, "parameter", None)) for each in actions]


def _meanings_of(at: int, scan: Lattice) -> set[Hashable]:
    """What a token means, alone or in a phrase."""
    return {_meaning(edge) for edge in scan.all() if edge.start <= at < edge.end and _says_what(edge)}


def _says_what(edge: Edge) -> bool:
    """Whether an edge says what something is about: things and settings do, verbs and small words do not."""
    concept = edge.concept
    return concept not in _SMALL and not concept.endswith(_SMALL_ENDINGS) and not concept.startswith("v.")


def _meaning(edge: Edge) -> Hashable:
    """What an edge means: nouns in the singular and the plural mean the same."""
    concept = edge.concept
    if concept.endswith((".one", ".many")):
        concept = concept.rpartition(".")[0]
    return concept, repr(edge.sense.value)


def _without_marks(tokens: Sequence[Token]) -> Sequence[Token]:
    """The tokens without marks at the end."""
    end = len(tokens)
    while end and not any(char.isalnum() for char in tokens[end - 1].text):
        end -= 1
    return tokens[:end]
