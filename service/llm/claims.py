"""Claims of a text: whether a rephrased explanation says the same as the original.

A model may change the wording of an explanation, not what it says. Both texts are reduced to their claims in
order: ids, numbers, moves, negations, and every other word that carries a fact (`claims.yaml`). A faithful
text has the same claims in the same order; the order keeps "vehicle-1 was left of me and pothole-2 right"
from becoming the reverse. Every other word must be neutral, or in the original. Many faithful texts are
rejected: that costs a nicer sentence, while accepting a wrong one would make an explanation false.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from service.llm.prompts import load_claims
from service.llm.protocol import Facts

Claim = tuple[str, str]
"""The sort of claim and its value: `("id", "vehicle-3")`, `("number", "12")`, `("word", "left")`."""

EXTRA_CHARS: Final = 80
"""An answer may have twice the characters of the original, and so many more."""

_TOKEN = re.compile(
    r"(?P<id>[^\W\d_]+-\d+)"
    r"|(?P<number>\d+(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
    r"|(?P<word>[^\W\d_]+(?:'[^\W\d_]+)?)"
)
_ADDRESS = re.compile(r"://|www\.|[a-z]\.[a-z]")
_PLAIN = frozenset(" .,;:!?'\"()-–—’‘“”…/→")
"""Punctuation that an answer may have, beside ASCII letters and digits."""


@dataclass(frozen=True, slots=True)
class Claims:
    """The words of a language that carry facts."""

    groups: dict[str, str]
    """Word → claim; synonyms have the same claim."""
    numbers: dict[str, str]
    neutral: frozenset[str]

    @classmethod
    def load(cls) -> Claims:
        """The words in `prompts/llm`. Raises `PromptError`."""
        values = load_claims()
        groups = {word: name for name, words in values["groups"].items() for word in words}
        numbers = {str(word): str(number) for word, number in values["numbers"].items()}
        return cls(groups, numbers, frozenset(values["neutral"]))

    def claims_in(self, text: str) -> tuple[Claim, ...]:
        """The claims of a text, in order."""
        return tuple(self._claims(text))

    def is_faithful(self, answer: str, text: str, facts: Facts) -> bool:
        """Whether an answer may replace a text that was made from these facts."""
        claims = self.claims_in(text)
        named = {value for sort, value in claims if sort == "id"}
        return (
            named <= set(_strings(facts))
            and 0 < len(answer) <= 2 * len(text) + EXTRA_CHARS
            and all(_plain(char) or char in text for char in answer)
            and _ADDRESS.search(answer.lower()) is None
            and self.claims_in(answer) == claims
            and self._foreign(answer, text) == set()
        )

    def _foreign(self, answer: str, text: str) -> set[str]:
        """The words of an answer that are neither in the text, nor claims, nor neutral."""
        return _words(answer) - _words(text) - self.groups.keys() - self.numbers.keys() - self.neutral

    def _claims(self, text: str) -> Iterator[Claim]:
        for match in _tokens(text):
            token = match.group()
            if match.lastgroup == "id":
                yield "id", token
            elif match.lastgroup == "number":
                yield "number", f"{float(token.replace(',', '')):.12g}"
            elif token in self.numbers:
                yield "number", self.numbers[token]
            else:
                for word in _split(token):
                    if word in self.groups:
                        yield "word", self.groups[word]


def _tokens(text: str) -> Iterator[re.Match[str]]:
    return _TOKEN.finditer(text.lower().replace("’", "'"))


def _split(word: str) -> tuple[str, ...]:
    return (word.removesuffix("n't"), "not") if word.endswith("n't") else (word,)


def _words(text: str) -> set[str]:
    return {part for match in _tokens(text) if match.lastgroup == "word" for part in _split(match.group())}


def _plain(char: str) -> bool:
    return char in _PLAIN or (char.isascii() and unicodedata.category(char)[0] in "LN")


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for part in value.values():
            yield from _strings(part)
    elif isinstance(value, list | tuple):
        for part in value:
            yield from _strings(part)
