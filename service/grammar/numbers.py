"""Numbers in digits and in words: "12", "1,000", "two hundred and fifty", "half a dozen", "minus 3".

A small parser of our own, because the words around a number decide what it may be: "a couple of" is a
number here, "a few" (a vague amount) and "second" (an ordinal) are not. Which words there are is data
(`numbers.yaml`), and so is whether they are written as one word and which mark is the decimal one.
Negative numbers and fractions are read as what they are; that a count cannot be one is for the
frames to say.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import takewhile
from typing import Any

from service.grammar.tokens import Token

Value = int | float
MAX_DIGITS = 15
MAX_DECIMALS = 40
"""Longer ones are no numbers anyone says; a float written out exactly is shorter."""
LONGEST_WORD = 80
"""Letters of the longest word that is read as a number in one word."""

REMEMBERED = 4_096
"""Words of which it is remembered which number they are."""

OPENING = ("(", "[")
"""After one of these "3,7" is a pair and not a number, whatever the decimal mark."""


@dataclass(frozen=True, slots=True)
class Found:
    """A number that starts at some token and ends before token `end`."""

    value: Value
    end: int


@dataclass(frozen=True, slots=True)
class Together:
    """How numbers are written as one word; there is none in languages that do not."""

    bound: Mapping[str, int]
    """Pieces that are no number by themselves: the "ein" of "einundzwanzig"."""
    link: str
    """What stands between ones and tens, and may stand after a power."""
    ones_first: bool

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Together:
        """From `{"bound": {"ein": 1}, "link": "und", "ones_first": True}`."""
        return cls(data.get("bound", {}), str(data.get("link", "")), bool(data.get("ones_first", False)))


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
    together: Together | None = None
    decimal: str = "."
    thousands: str = ","
    part_ending: str = "s"
    """What a word for a part ends in when there are several: "quarters"."""
    _first: frozenset[str] = field(init=False, repr=False, compare=False)
    """Words that a number may begin with, those put together aside."""
    _in_one_word: Callable[[str], int | None] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        tables = (self.ones, self.tens, self.fractions)
        first = self.minus | self.point | self.articles | {word for table in tables for word in table}
        object.__setattr__(self, "_first", first)
        # Taking a word apart is slow where numbers are written together, and most words are asked of again.
        object.__setattr__(self, "_in_one_word", lru_cache(REMEMBERED)(self._taken_apart))

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> NumberWords:
        """From the sections of `numbers.yaml`; lists are strings of words."""
        sets = {
            key: frozenset(str(data[key]).split()) for key in ("articles", "joins", "of", "minus", "point")
        }
        marks = data.get("marks", {"decimal": ".", "thousands": ","})
        return cls(
            together=Together.from_data(data["together"]) if "together" in data else None,
            decimal=marks["decimal"],
            thousands=marks["thousands"],
            part_ending=str(data.get("part_ending", "s")),
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

    def may_begin(self, token: Token) -> bool:
        """Whether any number begins with a token; nearly all tokens are no such."""
        if token.digits or token.text in self._first:
            return True
        return self.together is not None and self._in_one_word(token.text) is not None

    def ordinal(self, token: Token) -> int | None:
        """The place in a row a token names: "second" and "2nd" are 2."""
        if token.ordinal:
            return int(token.text) if len(token.text) <= 9 else None
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
            small = self._in_one_word(word)
            if small is not None and (begins or (last == "tens" and self._ends_tens(small))):
                part, last = part + small, "power" if self._ends_in_power(word) else "ones"
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
        return at < len(tokens) and (
            tokens[at].text in self.tens or self._in_one_word(tokens[at].text) is not None
        )

    def _ends_tens(self, value: int) -> bool:
        """Whether a word may follow one for tens: "twenty five", where that is how it is said."""
        return self.together is None and value in range(1, 10)

    def _ends_in_power(self, word: str) -> bool:
        """Whether more may be joined to a word: "hundert und fünf"."""
        return self.together is not None and word.endswith(tuple(self.powers))

    def _taken_apart(self, word: str) -> int | None:
        """The number that is one word: "seven", and "einundzwanzig" where words are put together."""
        plain = self.ones.get(word)
        if plain is not None or self.together is None or word in self.together.bound:
            return plain
        if word in self.tens or len(word) > LONGEST_WORD:
            return None
        powers = sorted(self.powers.items(), key=lambda power: (-power[1], -len(power[0])))
        return self._put_together(word, powers, self.together)

    def _put_together(self, word: str, powers: Sequence[tuple[str, int]], how: Together) -> int | None:
        """A number in one word that has none but these powers in it, the greatest first."""
        for at, (name, power) in enumerate(powers):
            head, found, tail = word.partition(name)
            if not found:
                continue
            below = [other for other in powers[at + 1 :] if other[1] < power]
            many = self._put_together(head, below, how) if head else 1
            rest = self._put_together(tail.removeprefix(how.link), below, how) if tail else 0
            if not many or rest is None:
                return None
            return many * power + rest
        return self._below_hundred(word, how)

    def _below_hundred(self, word: str, how: Together) -> int | None:
        small = {**self.ones, **how.bound}
        if word in small or word in self.tens:
            return small.get(word, self.tens.get(word))
        for ten, value in self.tens.items():
            one = word.removesuffix(how.link + ten) if how.ones_first else word.removeprefix(ten + how.link)
            if one != word and small.get(one, 0) in range(1, 10):
                return value + small[one]
        return None

    def _digits(self, tokens: Sequence[Token], at: int) -> Found | None:
        text, end = self._written_digits(tokens, at)
        if "/" in text:
            over, under = text.split("/")
            if len(text) > 12 or int(under) == 0:
                return None
            return Found(int(over) / int(under), end)
        plain = self._without_marks(text)
        if plain is None or len(plain) > (MAX_DECIMALS if "." in plain else MAX_DIGITS):
            return None
        if plain.isdigit():
            value = int(plain)
            if end < len(tokens) and not tokens[end].digits and tokens[end].text in self.powers:
                return Found(value * self.powers[tokens[end].text], end + 1)
            return Found(value, end)
        try:
            return Found(float(plain), end)
        except ValueError:
            return None

    def _written_digits(self, tokens: Sequence[Token], at: int) -> tuple[str, int]:
        """Digits and their marks as they were written without a space, and the token after them."""
        text, end = tokens[at].text, at + 1
        if self.decimal == "." or (at and tokens[at - 1].text in OPENING):
            return text, end
        touching = list(
            takewhile(
                lambda pair: pair[0].end == pair[1].start,
                zip(tokens[at:], tokens[at + 1 :], strict=False),
            )
        )
        for _, token in touching:
            if not (token.digits or (token.text == self.decimal and text[-1].isdigit())):
                break
            text, end = text + token.text, end + 1
        if not text[-1].isdigit():
            text, end = text[:-1], end - 1
        return text, end

    def _without_marks(self, text: str) -> str | None:
        """Digits with a point before the decimals and no other mark; None when marks are out of place."""
        head, _, decimals = text.partition(self.decimal)
        groups = head.split(self.thousands)
        if len(groups) > 1:
            grouped = all(len(group) == 3 for group in groups[1:]) and 1 <= len(groups[0]) <= 3
            if self.decimal == "." or (grouped and not groups[0].startswith("0")):
                head = "".join(groups)
            else:
                return text if len(groups) == 2 and not decimals else None
        elif self.decimal != "." and len(decimals) == 3 and not head.startswith("0"):
            return None
        return f"{head}.{decimals}" if decimals else head

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
        several = word.endswith(self.part_ending)
        return word.removesuffix(self.part_ending) in self.fractions and (several or how_many == 1)

    def _with_tail(self, tokens: Sequence[Token], found: Found) -> Found:
        """ "two and a half", "three quarters"."""
        at = found.end
        if (
            at + 1 < len(tokens)
            and tokens[at].text in self.joins
            and (tail := self._fraction(tokens, at + 1)) is not None
        ):
            return self._grouped(tokens, Found(found.value + tail.value, tail.end))
        if at < len(tokens) and self._names_parts(tokens[at].text, found.value):
            return Found(found.value * self.fractions[tokens[at].text.removesuffix(self.part_ending)], at + 1)
        return found
