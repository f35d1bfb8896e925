"""Tokens, phrase notation and the lexicon, each alone."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.grammar.lexicon import Lexicon, Sense
from service.grammar.patterns import PatternError, expand, read_macros
from service.grammar.tokens import Contractions, normalise, tokenise

SHORT = Contractions({"let's": ("let", "us")}, (("n't", ("not",)), ("'s", ())), frozenset({"nd"}))


def words(text: str) -> list[str]:
    return [token.text for token in tokenise(normalise(text), SHORT)]


@pytest.mark.parametrize(
    ("text", "tokens"),
    [
        ("Don’t add 15m", ["do", "not", "add", "15", "m"]),
        ("Let's go", ["let", "us", "go"]),
        ("the car's left", ["the", "car", "left"]),
        ("self-driving", ["self", "driving"]),
        ("spawn_probability = 0.3", ["spawn", "probability", "=", "0.3"]),
        ("A* at 40km/h", ["a*", "at", "40", "km/h"]),
        ("1,000 cars, 2 vans", ["1,000", "cars", ",", "2", "vans"]),
        ("(4,16)", ["(", "4", ",", "16", ")"]),
        ("add -3", ["add", "-", "3"]),
        ("5-10 cars", ["5", "-", "10", "cars"]),
        ("fog – now", ["fog", ",", "now"]),
        ("the 2nd lane", ["the", "2", "lane"]),
        ("４ cars", ["4", "cars"]),
    ],
)
def test_tokens(text: str, tokens: list[str]) -> None:
    assert words(text) == tokens


@given(st.text(max_size=100))
def test_every_visible_character_is_in_some_token_or_a_hyphen(text: str) -> None:
    plain = normalise(text)
    covered = {at for token in tokenise(plain, SHORT) for at in range(token.start, token.end)}
    left = {char for at, char in enumerate(plain) if at not in covered and not char.isspace()}
    assert left <= {"-"}


def test_phrase_notation() -> None:
    macros = read_macros({"car": "the (car|van)", "of": "of <car>"})
    assert expand("add, drop [in]", {}) == [("add",), ("drop",), ("drop", "in")]
    assert expand("left <of>", macros) == [("left", "of", "the", "car"), ("left", "of", "the", "van")]
    assert expand("<(> {n} <,> {n} <)>", {}) == [("(", "{n}", ",", "{n}", ")")]
    assert expand("take ... away", {}) == [("take", "...", "away")]


@pytest.mark.parametrize("pattern", ["(a|b", "a)", "[a", "<nothing> b"])
def test_faulty_notation_is_named(pattern: str) -> None:
    with pytest.raises(PatternError):
        expand(pattern, {})


def test_a_phrase_may_have_several_senses_and_values_take_the_numbers_said() -> None:
    lexicon = Lexicon({})
    lexicon.add_section({"v.remove": "clear", "weather": {"clear": "clear"}})
    lexicon.add_section({"place": [{"is": {"lane": "$1"}, "say": "lane {n}"}]})
    assert set(lexicon.senses_of(("clear",))) == {Sense("v.remove"), Sense("weather", "clear")}
    tokens = tokenise("lane 4", SHORT)
    from service.grammar.numbers import Found

    matches = lexicon.matches(tokens, 0, {1: Found(4, 2)}, {})
    assert [(end, senses[0].value) for end, senses, _ in matches] == [(2, {"lane": 4})]


def test_one_phrase_with_two_values_of_a_concept_collides() -> None:
    lexicon = Lexicon({})
    lexicon.add_section({"weather": {"rain": "wet", "snow": "wet"}})
    assert len(lexicon.collisions) == 1
