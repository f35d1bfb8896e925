"""What is repaired and, more to the point, what is not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.grammar import Language, Refused, Understood
from service.grammar.typos import within_one_edit


def edits(word: str) -> set[str]:
    """All words one Damerau edit from a word, made without looking at the code under test."""
    letters = "abcdefghijklmnopqrstuvwxyz"
    cuts = [(word[:at], word[at:]) for at in range(len(word) + 1)]
    return (
        {a + b[1:] for a, b in cuts if b}
        | {a + c + b for a, b in cuts for c in letters}
        | {a + c + b[1:] for a, b in cuts if b for c in letters}
        | {a + b[1] + b[0] + b[2:] for a, b in cuts if len(b) > 1}
    )


@given(st.text("abc", max_size=5), st.text("abc", max_size=5))
def test_one_edit_is_what_it_says(a: str, b: str) -> None:
    assert within_one_edit(a, b) == (a == b or b in edits(a))


@pytest.mark.parametrize(
    ("text", "wrote", "read"),
    [("add five potohles", "potohles", "potholes"), ("REMVOE all cones", "REMVOE", "remove")],
)
def test_a_correction_is_reported_as_written(language: Language, text: str, wrote: str, read: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Understood)
    assert [(c.wrote, c.read) for c in parsed.corrections] == [(wrote, read)]


@pytest.mark.parametrize(
    "text",
    [
        "add eigth potholes",
        "add sevn potholes",
        "add fiev potholes",
        "add five trunks",
        "add five canes",
        "wiat",
        "add thre cars",
        "turn lef",
        "add five talkers",
        "make it bright in here",
    ],
)
def test_numbers_short_words_and_real_words_are_never_guessed(language: Language, text: str) -> None:
    assert isinstance(language.parse(text), Refused)
