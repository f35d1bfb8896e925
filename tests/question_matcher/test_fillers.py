"""Words that are left out of a question: what is left asks the same, and what supposes something stays."""

from __future__ import annotations

import pytest

from service.question_matcher.fillers import Fillers
from service.resources import prompts_folder

FILLERS = {code: Fillers(prompts_folder() / "questions" / code) for code in ("en", "de")}


@pytest.mark.parametrize(
    ("code", "text", "left"),
    [
        ("en", "Honestly, why did you stop, in your opinion?", "why did you stop?"),
        ("en", "which car is most dangerous, do you think?", "which car is most dangerous?"),
        ("en", "I am confused. Why did you go left?", "Why did you go left?"),
        ("de", "Warum hast du denn eigentlich angehalten?", "Warum hast du angehalten?"),
    ],
)
def test_a_question_without_what_does_not_change_it(code: str, text: str, left: str) -> None:
    assert left in FILLERS[code].without(text)


@pytest.mark.parametrize(
    ("text", "supposed"),
    [
        ("Suppose it rained. Would you really stop?", "it rained"),
        ("There is no car. Would you honestly go left?", "no car"),
    ],
)
def test_a_sentence_that_supposes_something_is_not_left_out(text: str, supposed: str) -> None:
    shorter = FILLERS["en"].without(text)
    assert shorter
    assert all(supposed in each for each in shorter)


@pytest.mark.parametrize("word", ["else", "instead", "again", "only", "not", "never", "without"])
def test_a_word_that_turns_a_question_stays(word: str) -> None:
    shorter = FILLERS["en"].without(f"honestly, what could you do {word} here ok")
    assert shorter
    assert all(word in each.split() for each in shorter)


@pytest.mark.parametrize(
    "text", ["Does fog hurt the lidar most? Numbers, please.", "The grid shows the cell as free. How come?"]
)
def test_a_few_words_are_not_read_without_the_sentence_that_they_lean_on(text: str) -> None:
    start = text.split()[0]
    assert all(each.startswith(start) for each in FILLERS["en"].without(text))


def test_a_sentence_that_refers_to_another_is_not_read_without_it() -> None:
    assert "What was that for?" not in FILLERS["en"].without("It zigzagged in the middle. What was that for?")
    assert "Where are we going?" in FILLERS["en"].without("It zigzagged in the middle. Where are we going?")
