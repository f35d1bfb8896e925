"""Numbers in digits and in words: "12", "1,000", "two hundred and fifty", "half a dozen", "minus 3".

A small parser of our own, because the words around a number decide what it may be: "a couple of" is a
number here, "a few" (a vague amount) and "second" (an ordinal) are not. Which words there are is data
(`numbers.yaml`). Negative numbers and fractions are read as what they are; that a count
cannot be one is for the frames to say.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from service.language.tokens import Token

Value = int | float


@dataclass(frozen=True, slots=True)
class Found:
    """A number that starts at some token and ends before token `end`."""

    value: Value
    end: int


@dataclass(frozen=True, slots=True)
class NumberWords:
    """The words of `numbers.yaml`."""

    ones: Mapping[str, int]
    tens: Mapping[str, int]
    powers: Mapping[str, int]
    groups: Mapping[str, int]
    fractions: Mapping[str, float]
    ordinals: Mapping[str, int]
    articles: frozenset[str]
    joins: frozenset[str]
    of: frozenset[str]
    minus: frozenset[str]
    point: frozenset[str]

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> NumberWords:
        """From the sections of `numbers.yaml`; lists are strings of words."""
        sets = {
            key: frozenset(str(data[key]).split()) for key in ("articles", "joins", "of", "minus", "point")
        }
        return cls(
            ones=data["ones"],
            tens=data["tens"],
            powers=data["powers"],
            groups=data["groups"],
            fractions=data["fractions"],
            ordinals=data["ordinals"],
            **sets,
        )

    def words(self) -> frozenset[str]:
        """Every word that can be part of a number and of little else: never guessed at in a typo."""
        tables = (self.ones, self.tens, self.powers, self.groups, self.fractions, self.ordinals)
        return frozenset(word for table in tables for word in table) | self.minus | self.point

    def ordinal(self, token: Token) -> int | None:
        """The place in a row a token names: "second" and "2nd" are 2."""
        if token.digits:
            head = token.text.rstrip("stndrh")
            return int(head) if head != token.text and len(head) <= 9 else None
        return self.ordinals.get(token.text)

    def read(self, tokens: Sequence[Token], at: int) -> Found | None:
        """The longest number that starts at token `at`, or None."""
        if at < len(tokens) and tokens[at].text in self.minus:
            found = self._positive(tokens, at + 1)
            return Found(-found.value, found.end) if found else None
        return self._positive(tokens, at)

    def _positive(self, tokens: Sequence[Token], at: int) -> Found | None:
        found = self._whole(tokens, at) or self._fraction(tokens, at)
        if found is None:
            return None
        found = self._grouped(tokens, found)
        return self._with_tail(tokens, found)

    def _whole(self, tokens: Sequence[Token], at: int) -> Found | None:
        if at >= len(tokens):
            return None
        token = tokens[at]
        if token.digits:
            return self._digits(tokens, at)
        if token.text in self.point:
            return self._decimals(tokens, Found(0, at))
        start = at
        if token.text in self.articles:
            at += 1
            if at >= len(tokens):
                return None
            if tokens[at].text not in self.powers and tokens[at].text not in self.groups:
                return None
        return self._spelt(tokens, start, at)

    def _spelt(self, tokens: Sequence[Token], start: int, at: int) -> Found | None:
        """A spelt number; `start` differs from `at` after an article, which then counts as one."""
        total, part, last = 0, 1 if start != at else 0, "article" if start != at else "nothing"
        while at < len(tokens):
            word = tokens[at].text
            begins = last in ("nothing", "power", "join")
            if word in self.ones and (begins or (last == "tens" and self.ones[word] in range(1, 10))):
                part, last = part + self.ones[word], "ones"
            elif word in self.tens and begins:
                part, last = part + self.tens[word], "tens"
            elif word in self.powers and last in ("ones", "tens", "article", "power"):
                power = self.powers[word]
                if power == 100:
                    if part == 0 or part >= 100:
                        break
                    part *= power
                else:
                    if part == 0:
                        break
                    total, part = total + part * power, 0
                last = "power"
            elif word in self.joins and last == "power" and self._continues(tokens, at + 1):
                last = "join"
            else:
                break
            at += 1
        if last == "nothing":
            return None
        if last == "article":
            return Found(1, at)
        return self._decimals(tokens, Found(total + part, at))

    def _continues(self, tokens: Sequence[Token], at: int) -> bool:
        return at < len(tokens) and (tokens[at].text in self.ones or tokens[at].text in self.tens)

    def _digits(self, tokens: Sequence[Token], at: int) -> Found | None:
        text = tokens[at].text.replace(",", "")
        if "/" in text:
            over, under = text.split("/")
            if len(text) > 12 or int(under) == 0:
                return None
            return Found(int(over) / int(under), at + 1)
        if len(text) > 15:
            return None
        if text.isdigit():
            value = int(text)
            if at + 1 < len(tokens) and not tokens[at + 1].digits and tokens[at + 1].text in self.powers:
                return Found(value * self.powers[tokens[at + 1].text], at + 2)
            return Found(value, at + 1)
        try:
            return Found(float(text), at + 1)
        except ValueError:
            return None

    def _decimals(self, tokens: Sequence[Token], whole: Found) -> Found:
        """The digits after a spoken point: "zero point four"."""
        at = whole.end
        if at >= len(tokens) or tokens[at].text not in self.point:
            return whole
        digits, at = "", at + 1
        while at < len(tokens) and len(digits) < 9 and self.ones.get(tokens[at].text, 10) < 10:
            digits, at = digits + str(self.ones[tokens[at].text]), at + 1
        return Found(float(f"{whole.value}.{digits}"), at) if digits else whole

    def _fraction(self, tokens: Sequence[Token], at: int) -> Found | None:
        """ "half", "a quarter", "half a" (before a dozen or a unit)."""
        if at < len(tokens) and tokens[at].text in self.articles:
            at += 1
        if at >= len(tokens) or tokens[at].text not in self.fractions:
            return None
        value, at = self.fractions[tokens[at].text], at + 1
        if at < len(tokens) and tokens[at].text in self.of:
            at += 1
        if at + 1 < len(tokens) and tokens[at].text in self.articles:
            at += 1
        return Found(value, at)

    def _grouped(self, tokens: Sequence[Token], found: Found) -> Found:
        """ "two dozen", "a couple of", "half a dozen": a number of groups."""
        at = found.end
        if at < len(tokens) and tokens[at].text in self.groups:
            value = found.value * self.groups[tokens[at].text]
            at += 1
            if at < len(tokens) and tokens[at].text in self.of:
                at += 1
            return Found(int(value) if value == int(value) else value, at)
        return found

    def _names_parts(self, word: str, how_many: Value) -> bool:
        """Whether a word after a number names so many parts: "one half", "three quarters"."""
        return word.rstrip("s") in self.fractions and (word.endswith("s") or how_many == 1)

    def _with_tail(self, tokens: Sequence[Token], found: Found) -> Found:
        """ "two and a half", "three quarters"."""
        at = found.end
        if (
            at + 1 < len(tokens)
            and tokens[at].text in self.joins
            and (tail := self._fraction(tokens, at + 1)) is not None
        ):
            return Found(found.value + tail.value, tail.end)
        if at < len(tokens) and self._names_parts(tokens[at].text, found.value):
            return Found(found.value * self.fractions[tokens[at].text.rstrip("s")], at + 1)
        return found
