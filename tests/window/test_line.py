"""Editing a line: any order of edits leaves a text with a cursor in it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.window.text_input import MAX_CHARS, Line

EDITS = (
    "insert",
    "backspace",
    "delete",
    "delete_word",
    "delete_before",
    "home",
    "end",
    "older",
    "newer",
    "send",
)


def line(text: str, cursor: int | None = None) -> Line:
    made = Line()
    made.set(text)
    if cursor is not None:
        made.cursor = cursor
    return made


@pytest.mark.parametrize(
    ("edit", "text", "cursor", "after", "cursor_after"),
    [
        ("backspace", "abc", 2, "ac", 1),
        ("backspace", "abc", 0, "abc", 0),
        ("delete", "abc", 1, "ac", 1),
        ("delete", "abc", 3, "abc", 3),
        ("delete_word", "add five  potholes", 10, "add potholes", 4),
        ("delete_word", "add", 3, "", 0),
        ("delete_before", "add five", 4, "five", 0),
        ("home", "abc", 2, "abc", 0),
        ("end", "abc", 0, "abc", 3),
    ],
)
def test_edits(edit: str, text: str, cursor: int, after: str, cursor_after: int) -> None:
    made = line(text, cursor)
    getattr(made, edit)()
    assert (made.text, made.cursor) == (after, cursor_after)


def test_letters_of_any_script_go_in_at_the_cursor() -> None:
    made = line("ab", 1)
    made.insert("é中🚗")
    assert (made.text, made.cursor) == ("aé中🚗b", 4)


def test_what_is_pasted_becomes_one_line_without_what_has_no_shape() -> None:
    made = line("")
    made.insert("add\nfive\x00\x1b[31m potholes\r\n")
    assert made.text == "add five[31m potholes  "


def test_no_more_than_can_be_read() -> None:
    made = line("x" * (MAX_CHARS - 2))
    made.insert("abcdef")
    assert len(made.text) == MAX_CHARS


def test_words_are_stepped_over() -> None:
    made = line("add five potholes")
    made.move_word(-1)
    assert made.cursor == 9
    made.move_word(-1)
    assert made.cursor == 4
    made.move_word(1)
    assert made.cursor == 8


def test_what_was_sent_comes_back_in_order_and_what_was_being_written_last() -> None:
    made = line("")
    for text in ("one", "two", "one", "three"):
        made.set(text)
        assert made.send() == text
    assert made.sent == ["two", "one", "three"]
    made.set("begun")
    seen = []
    for step in (
        made.older,
        made.older,
        made.older,
        made.older,
        made.newer,
        made.newer,
        made.newer,
        made.newer,
    ):
        step()
        seen.append(made.text)
    assert seen == ["three", "one", "two", "two", "one", "three", "begun", "begun"]


@given(st.lists(st.tuples(st.sampled_from(EDITS), st.text(max_size=8))))
def test_the_cursor_is_always_in_the_text(edits: list[tuple[str, str]]) -> None:
    made = line("")
    for edit, text in edits:
        made.insert(text) if edit == "insert" else getattr(made, edit)()
        assert 0 <= made.cursor <= len(made.text) <= MAX_CHARS
        assert made.text.isprintable()
