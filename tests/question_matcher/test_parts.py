"""Texts that ask several things: where they are split, and what leans on the part before."""

from __future__ import annotations

import pytest

from service.question_matcher.parts import Parts
from service.resources import prompts_folder

PARTS = {code: Parts(prompts_folder() / "questions" / code) for code in ("en", "de")}


@pytest.mark.parametrize(
    ("code", "text", "parts"),
    [
        (
            "en",
            "how far is the goal, and when do we get there?",
            ["how far is the goal", "when do we get there?"],
        ),
        (
            "en",
            "how many moves did it take and whats the minimum",
            ["how many moves did it take", "whats the minimum"],
        ),
        ("en", "Everything ok? Any close calls?", ["Everything ok?", "Any close calls?"]),
        ("en", "why did it stop - is it the fog", ["why did it stop", "is it the fog"]),
        ("de", "Wie weit ist es noch und wann sind wir da?", ["Wie weit ist es noch", "wann sind wir da?"]),
    ],
)
def test_a_text_is_split_where_a_question_begins(code: str, text: str, parts: list[str]) -> None:
    assert [part.text for part in PARTS[code].of(text)] == parts


@pytest.mark.parametrize(
    ("code", "text"),
    [
        ("en", "why did you stop?"),
        ("en", "which is nearer, the car or the pothole?"),
        ("en", "did you see the car on the left and the one in front?"),
        ("en", "when it stopped, was there something in the way?"),  # the first part is no question
        ("en", "if it rained, would you stop?"),
        ("en", "It stopped there. Was that needed?"),  # a statement that the question leans on
        ("en", "why? when? where? how?"),
        ("de", "Wenn es regnet, würdest du anhalten?"),
    ],
)
def test_what_is_one_question_stays_whole(code: str, text: str) -> None:
    assert not PARTS[code].of(text)


@pytest.mark.parametrize(
    ("code", "text", "leans", "leans_on_a_thing"),
    [
        ("en", "how many lane changes, and were they needed?", True, False),
        ("en", "did it stop, and why?", True, False),
        ("en", "how long did it take and is that quick?", True, False),
        ("en", "where is the car and is it coming closer?", False, True),
        ("en", "what is the seed and how many cars are there?", False, False),
        ("de", "Wie oft hast du gewechselt, und war das nötig?", True, False),
    ],
)
def test_what_refers_to_the_part_before_leans_on_it(
    code: str, text: str, leans: bool, leans_on_a_thing: bool
) -> None:
    first, last = PARTS[code].of(text)
    assert not first.leans
    assert (last.leans, last.leans_on_a_thing) == (leans, leans_on_a_thing)
