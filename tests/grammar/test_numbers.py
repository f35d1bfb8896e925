"""Numbers against an independent speller, and the shapes a speller does not make."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from text_to_num import text2num

from service.grammar import Language
from service.grammar.numbers import NumberWords
from service.grammar.tokens import Contractions, normalise, tokenise
from service.yaml_files import read_yaml
from tests.grammar.beside import FOLDER

NUMBERS = NumberWords.from_data(read_yaml(FOLDER / "numbers.yaml"))
NONE = Contractions({}, ())

SMALL = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
]
TENS = ["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]


def spell(number: int, *, british: bool) -> str:
    """An English number in words, written for this test."""
    if number < 20:
        return SMALL[number]
    if number < 100:
        tens, rest = divmod(number, 10)
        return TENS[tens - 2] + (f"-{SMALL[rest]}" if rest else "")
    for power, name in ((1000, "thousand"), (100, "hundred")):
        if number >= power:
            head, rest = divmod(number, power)
            joint = " and " if british and 0 < rest < 100 else " "
            tail = joint + spell(rest, british=british) if rest else ""
            return f"{spell(head, british=british)} {name}{tail}"
    raise AssertionError(number)


def read(text: str) -> tuple[float, bool] | None:
    """The number a text starts with, and whether it is all of the text."""
    tokens = tokenise(normalise(text), NONE)
    found = NUMBERS.read(tokens, 0)
    return (found.value, found.end == len(tokens)) if found else None


@given(st.integers(0, 999_999), st.booleans())
def test_spelt_numbers_are_read_back(number: int, british: bool) -> None:
    assert read(spell(number, british=british)) == (number, True)


@pytest.mark.parametrize("number", [*range(0, 2_000, 7), *range(2_000, 1_000_000, 4_999)])
def test_another_reader_agrees(number: int) -> None:
    said = spell(number, british=False).replace("-", " ")
    assert read(said) == (text2num(said, "en"), True)


@given(st.integers(0, 10**9))
def test_digits_are_read_with_and_without_separators(number: int) -> None:
    assert read(str(number)) == (number, True)
    assert read(f"{number:,}") == (number, True)


@given(st.decimals(0, 1000, places=3))
def test_decimals_are_read(number: object) -> None:
    found = read(str(number))
    assert found is not None
    assert found[0] == pytest.approx(float(str(number)))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a dozen", 12),
        ("half a dozen", 6),
        ("two dozen", 24),
        ("a couple of", 2),
        ("a pair of", 2),
        ("a hundred", 100),
        ("a hundred and five", 105),
        ("half a", 0.5),
        ("a quarter", 0.25),
        ("three quarters", 0.75),
        ("two and a half", 2.5),
        ("zero point four", 0.4),
        ("point five", 0.5),
        ("minus three", -3),
        ("-3", -3),
        ("1/2", 0.5),
        ("3 thousand", 3000),
    ],
)
def test_other_shapes(text: str, value: float) -> None:
    found = read(text + " x")
    assert found is not None
    assert found[0] == pytest.approx(value)


TENS_FIRST = NumberWords.from_data(
    {
        **read_yaml(FOLDER / "numbers.yaml"),
        "ones": {"uno": 1, "due": 2, "sette": 7, "dieci": 10},
        "tens": {"venti": 20, "trenta": 30},
        "powers": {"cento": 100, "mila": 1000},
        "together": {"link": ""},
    }
)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("due", 2),
        ("trentadue", 32),
        ("cento", 100),
        ("duecentoventisette", 227),
        ("trentaduemiladuecentodieci", 32_210),
        ("trentaventi", None),
        ("centouno due", 101),
        ("duetrenta", None),
        ("centocento", None),
    ],
)
def test_numbers_in_one_word_with_the_tens_before_the_ones(text: str, value: int | None) -> None:
    found = TENS_FIRST.read(tokenise(text, NONE), 0)
    assert (found.value if found else None) == value


def test_numbers_in_one_word_are_read_only_where_the_data_say_so() -> None:
    assert read("twentyone") is None
    assert read("two hundredfive") == (2, False)


@pytest.mark.parametrize("text", ["a car", "and", "cars", "few", "hundred cars of", ""])
def test_what_is_no_number(text: str) -> None:
    assert read(text) is None


@pytest.mark.parametrize(
    "text", ["add -3 cars", "add minus three cars", "add 2.5 cars", "add two and a half cars", "add 0 cars"]
)
def test_impossible_counts_are_called_impossible(language: Language, text: str) -> None:
    parsed = language.parse(text)
    assert getattr(parsed, "reason", None) == "impossible"
