"""Text → tokens: words, numbers and marks, each with its place in the text.

Lower-casing, typographic variants, underscores, hyphens and contractions are settled here, so that
no later stage sees them. Which contractions there are is data. Nothing is ever dropped: a
character with no use of its own becomes a token that no phrase contains, and so causes a refusal.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from sim.types import Kind

_VARIANTS = str.maketrans(
    {
        "“": '"',
        "”": '"',
        "„": '"',
        "’": "'",
        "‘": "'",
        "´": "'",
        "`": "'",
        "–": "-",
        "—": "-",
        "−": "-",
        "_": " ",
        "×": "x",
    }
)

_TOKEN = re.compile(
    rf"""(?P<id>\b(?:{"|".join(Kind)})-[0-9]{{1,9}}\b)
      | (?P<fraction>[0-9]+/[0-9]+)
      | (?P<number>[0-9]{{1,3}}(?:,[0-9]{{3}})+(?:\.[0-9]+)?(?![0-9]) | [0-9]*\.[0-9]+ | [0-9]+)
      | (?P<word>[^\W\d_]+/[^\W\d_]+ | [^\W\d_]+(?:'[^\W\d_]+)*\*?)
      | (?P<mark>\S)""",
    re.VERBOSE | re.IGNORECASE,
)


class Token(NamedTuple):
    """One word or mark: `text` as the lexicon knows it, `[start, end)` its place in the written text."""

    text: str
    start: int
    end: int
    digits: bool = False
    ordinal: bool = False
    """Whether it is a place in a row in digits: "3rd"."""
    id: bool = False
    """Whether it is the id of a thing: "pothole-3"."""


@dataclass(frozen=True, slots=True)
class Contractions:
    """How short forms are written out: whole words first, then endings."""

    words: Mapping[str, tuple[str, ...]]
    endings: tuple[tuple[str, tuple[str, ...]], ...]
    ordinals: frozenset[str] = frozenset()
    """what makes a number in digits a place in a row: "rd" """

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Contractions:
        """From `{"words": {"gimme": "give me"}, "endings": {"n't": "not"}}`."""
        words = {short: tuple(str(full).split()) for short, full in data["words"].items()}
        endings = tuple((end, tuple(str(full).split())) for end, full in data["endings"].items())
        return cls(words, endings, frozenset(str(data.get("ordinals", "")).split()))

    def with_spellings(self, words: Collection[str], spellings: Sequence[Mapping[str, str]]) -> Contractions:
        """These, and the words in other spellings: "strasse" is "straße" where no other word is so written.

        `spellings`: what letters are written as, in each of the ways that are usual.
        """
        found: dict[str, tuple[str, ...]] = {}
        for letters in spellings:
            table = str.maketrans(dict(letters))
            for word in words:
                other = word.translate(table)
                if other not in words and other not in self.words:
                    found.setdefault(other, (word,))
        return replace(self, words={**found, **self.words})

    def expand(self, word: str) -> tuple[str, ...]:
        """The words a written word stands for; itself when it is no short form."""
        if whole := self.words.get(word):
            return whole
        if "'" in word:
            for ending, full in self.endings:
                if word.endswith(ending) and len(word) > len(ending):
                    return (word[: -len(ending)], *full)
        return (word,)


def normalise(text: str) -> str:
    """The text with compatibility characters and typographic variants in their plain form."""
    text = text.translate(_VARIANTS)
    return text if text.isascii() else unicodedata.normalize("NFKC", text)


def restore_marks(text: str, plain: str) -> str:
    """The text with marks as they were written, character by character beside its normal form.

    Where the normal form is of another length ("ﬁ" is two letters) it is the normal form itself.
    """
    said = text if text.isascii() else unicodedata.normalize("NFKC", text)
    return said if len(said) == len(plain) else plain


def tokenise(text: str, contractions: Contractions) -> list[Token]:
    """Tokens of a normalised text, in order, contractions written out."""
    tokens: list[Token] = []
    for match in _TOKEN.finditer(text):
        start, end = match.span()
        written = match.group().lower()
        kind = match.lastgroup
        if kind == "word" and written in contractions.ordinals and _ends_number(tokens, start):
            number = tokens.pop()
            tokens.append(Token(number.text, number.start, end, ordinal=True))
        elif kind == "word":
            tokens.extend(Token(part, start, end) for part in contractions.expand(written))
        elif kind == "mark":
            if written == "-":
                mark = _dash(text, start)
                if mark:
                    tokens.append(Token(mark, start, end))
            else:
                tokens.append(Token(written, start, end))
        elif kind == "id":
            tokens.append(Token(written, start, end, id=True))
        else:
            tokens.append(Token(written, start, end, digits=True))
    return tokens


def _ends_number(tokens: Sequence[Token], start: int) -> bool:
    """Whether what begins here follows a whole number without a space."""
    return bool(tokens) and tokens[-1].digits and tokens[-1].text.isdigit() and tokens[-1].end == start


def _dash(text: str, at: int) -> str:
    """What a dash is: nothing inside a compound word, a minus before a number, else a pause."""
    before = text[at - 1] if at else " "
    after = text[at + 1] if at + 1 < len(text) else " "
    if before.isdigit() and after.isdigit():
        return "-"
    if before.isalnum() and after.isalpha():
        return ""
    if not before.isalnum() and (after.isdigit() or after == "."):
        return "-"
    return ","


def written(text: str, tokens: Sequence[Token]) -> str:
    """The stretch of text from the first token to the last, as it was written."""
    return text[tokens[0].start : tokens[-1].end] if tokens else ""


def with_text(token: Token, word: str) -> Token:
    """The same place in the text, read as another word."""
    return token._replace(text=word)
