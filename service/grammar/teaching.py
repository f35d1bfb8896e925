"""Teaches phrases that take numbers, or that mean rules: "when I say wall N, I mean N barriers in row 10".

What such a phrase means is read several times, with other numbers in the place of its parameters: the figures
that change with a number are those it stands for. Where anything else changes, nothing is taught.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from service.actions import Action, Teach, dump
from service.actions.parameters import MAX_PARAMETERS, PhraseParameter, paths
from service.grammar.free_text import find_taught
from service.grammar.parse_types import Parse, Understood
from service.grammar.tokens import Token, normalise, restore_marks, tokenise
from service.grammar.topic import Topic
from service.grammar.work_budget import WorkBudget

if TYPE_CHECKING:
    from service.grammar.engine import Language

_TRIED = ((2, 3, 5), (3, 5, 7), (4, 2, 9))
"""Numbers that are put in the place of parameters, each row for one reading: no column is like another."""


def read_teaching(language: Language, text: str, topic: Topic, work: WorkBudget) -> Parse | None:
    """The lesson that a text is; None for any other."""
    plain = normalise(text)
    tokens = tokenise(plain, language.data.contractions)
    found = find_taught(tokens, language.data.lexicon, restore_marks(text, plain))
    if found is None:
        return None
    start, name, meant = found
    if meant >= len(tokens):
        return None
    named = _parameters(language, tokens[start : name.end], tokens[meant:], plain)
    lesson = _lesson(language, name.text, named, _Meaning(plain, tokens[meant:]), topic, work)
    return None if lesson is None else Understood(text, (lesson,))


class _Meaning:
    """The words that a phrase means."""

    def __init__(self, plain: str, tokens: Sequence[Token]) -> None:
        self._plain, self._tokens = plain, tokens

    def text(self, numbers: dict[str, int]) -> str:
        """The words, with numbers in the place of parameters."""
        start, said = self._tokens[0].start, ""
        for token in self._tokens:
            if token.text in numbers:
                said += f"{self._plain[start : token.start]}{numbers[token.text]}"
                start = token.end
        return said + self._plain[start : self._tokens[-1].end]


def _parameters(
    language: Language, phrase: Sequence[Token], meaning: Sequence[Token], plain: str
) -> tuple[str, ...]:
    """The words of a phrase that stand for numbers: single letters that the meaning has as well."""
    meant = {token.text for token in meaning}
    articles = language.data.numbers.articles
    return tuple(
        token.text
        for token in phrase[1:]
        if len(plain[token.start : token.end]) == 1
        and token.text.isalpha()
        and token.text in meant
        and token.text not in articles
    )


def _lesson(
    language: Language,
    phrase: str,
    names: tuple[str, ...],
    meaning: _Meaning,
    topic: Topic,
    work: WorkBudget,
) -> Teach | None:
    if len(names) > MAX_PARAMETERS:
        return None
    readings: list[tuple[Action, ...]] = []
    for numbers in _TRIED if names else _TRIED[:1]:
        actions = language.meaning(meaning.text(dict(zip(names, numbers, strict=False))), topic, work)
        if actions is None:
            return None
        readings.append(actions)
    try:
        if not names:
            return Teach(phrase=phrase, meaning=readings[0])
        figures = _figures([paths(dump(each)) for each in readings], len(names))
        if figures is None:
            return None
        as_said = {word.casefold(): word for word in phrase.split()}
        taught = tuple(
            PhraseParameter(name=as_said.get(name, name), figures=tuple(figures[at]))
            for at, name in enumerate(names)
        )
        return Teach(phrase=phrase, meaning=readings[0], parameters=taught)
    except ValueError:
        return None


def _figures(readings: Sequence[dict[str, Any]], count: int) -> list[list[str]] | None:
    """The paths of the figures that are each number; None where something else changes with them."""
    if any(one.keys() != other.keys() for one, other in pairwise(readings)):
        return None
    columns = [[row[at] for row in _TRIED] for at in range(count)]
    found: list[list[str]] = [[] for _ in columns]
    for path in readings[0]:
        values = [reading[path] for reading in readings]
        if all(value == values[0] for value in values):
            continue
        if values not in columns:
            return None
        found[columns.index(values)].append(path)
    return found if all(found) else None
