"""Guarantees of the engine that no list of sentences shows: robustness, refusals, questions, suggestions."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.actions import dump
from service.grammar import Ambiguous, Language, Refused, Understood
from service.grammar.data import read_language
from service.grammar.evaluation import read_labelled
from service.grammar.parse_types import Parse
from service.resources import prompts_folder
from tests.grammar.beside import HERE, beside

DEV = read_labelled(HERE / "dev.jsonl")
WORDS = sorted({word for row in DEV for word in row.text.split()})
LANGUAGE = Language.load()


@cache
def read_dev(language: Language) -> Sequence[Parse]:
    """What each of the sentences means."""
    return [language.parse(row.text) for row in DEV]


@settings(max_examples=300, deadline=None)
@given(st.text(max_size=500))
def test_any_text_gets_one_of_three_answers(text: str) -> None:
    assert isinstance(LANGUAGE.parse(text), Understood | Refused | Ambiguous)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=30))
def test_known_words_in_any_order_get_one_of_three_answers(words: list[str]) -> None:
    parsed = LANGUAGE.parse(" ".join(words))
    assert isinstance(parsed, Understood | Refused | Ambiguous)
    if isinstance(parsed, Understood):
        assert parsed.actions


@settings(max_examples=200, deadline=None)
@given(st.sampled_from([row for row in DEV if row.actions]), st.integers(0, 12))
def test_a_foreign_word_anywhere_refuses_the_whole(row: object, place: int) -> None:
    words = row.text.split()  # type: ignore[attr-defined]
    if any(action["do"] in ("save", "load") for action in row.actions):  # type: ignore[attr-defined]
        return
    words.insert(min(place, len(words)), "quetzalcoatl")
    parsed = LANGUAGE.parse(" ".join(words))
    assert isinstance(parsed, Refused)
    assert any("quetzalcoatl" in phrase for phrase in parsed.unparsed)


@pytest.mark.parametrize(
    "text",
    [
        "add " * 2500,
        "a," * 5000,
        "add five potholes and " * 500,
        "(" * 10000,
        "é" * 10000,
        "not " * 2500,
        "1 " * 5000,
        "put put put " * 90,
        "in the left lane " * 60,
        "," * 10000,
    ],
)
def test_long_text_is_answered_in_bounded_time(language: Language, text: str) -> None:
    start = time.thread_time()  # of the work alone: others may share the machine
    assert isinstance(language.parse(text), Refused)
    assert time.thread_time() - start < 20, "what grows without bounds takes hours"


@pytest.mark.parametrize("row", [row for row in DEV if row.actions][:200:7], ids=lambda row: row.text)
def test_capitals_marks_and_politeness_change_nothing(language: Language, row: object) -> None:
    actions = row.actions  # type: ignore[attr-defined]
    if any(action["do"] in ("save", "load") for action in actions):
        return
    text = row.text.rstrip(".!?")  # type: ignore[attr-defined]
    for said in (text.upper(), f"  {text}  ", f"{text}!", f"um, {text}, please"):
        parsed = language.parse(said)
        assert isinstance(parsed, Understood), said
        assert dump(parsed.actions) == json.loads(json.dumps(actions)), said


def test_parsing_is_a_function_of_the_text_alone(language: Language) -> None:
    first = read_dev(language)
    assert first == [language.parse(row.text) for row in DEV]
    another = Language(read_language(prompts_folder() / "language" / "en"))  # read anew, and asked backwards
    assert first == [another.parse(row.text) for row in reversed(DEV)][::-1]


def test_a_refusal_names_the_words_as_written_and_what_was_understood(language: Language) -> None:
    parsed = language.parse("Add five potholes and Order Pizza")
    assert isinstance(parsed, Refused)
    assert parsed.reason == "not_understood"
    assert parsed.unparsed == ("Order Pizza",)
    assert parsed.message == 'I did not understand "Order Pizza". Nothing was changed.'
    assert parsed.suggestions


def test_a_refused_part_of_known_words_is_named(language: Language) -> None:
    parsed = language.parse("add five potholes and lane the")
    assert isinstance(parsed, Refused)
    assert parsed.unparsed == ("lane the",)
    assert parsed.understood == ("add five potholes",) or not parsed.understood


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "empty"),
        ("   \n", "empty"),
        ("don't add any potholes", "negation"),
        ("please don't pause", "negation"),
        ("add minus three potholes", "impossible"),
        ("make me a sandwich", "not_understood"),
        ("please", "not_understood"),
    ],
)
def test_why_a_sentence_was_refused(language: Language, text: str, reason: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.reason == reason
    assert parsed.message


def test_every_suggestion_ever_offered_can_be_said(language: Language) -> None:
    sayings = [say for frame in language.data.frames for say in frame.says]
    assert len(sayings) > 60
    assert [say for say in sayings if not isinstance(language.parse(say), Understood)] == []


def test_refusals_offer_at_most_three_different_sayings(language: Language) -> None:
    for parsed in (*map(language.parse, beside("refuse")), *read_dev(language)):
        if isinstance(parsed, Refused):
            assert len(set(parsed.suggestions)) == len(parsed.suggestions) <= 3


@pytest.mark.parametrize(
    "text",
    [
        "slow down",
        "faster",
        "double the speed",
        "set the speed to 5",
        "remove the cone",
        "add potholes",
        "create five cars",
        "there should be two cones",
        "set the probability to 20 %",
        "raise the speed",
        "pause and slow down",
        "add two cones, speed up, then pause",
        "halve the speed",
        "add more cars",
    ],
)
def test_each_choice_of_a_question_says_exactly_what_it_does(language: Language, text: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Ambiguous)
    assert parsed.question.endswith("?")
    assert len(parsed.choices) >= 2
    for choice in parsed.choices:
        again = language.parse(choice.text)
        assert isinstance(again, Understood), choice.text
        assert again.actions == choice.actions


def test_a_question_within_a_compound_keeps_the_rest(language: Language) -> None:
    parsed = language.parse("pause and slow down")
    assert isinstance(parsed, Ambiguous)
    assert all(dump(choice.actions)[0] == {"do": "pause"} for choice in parsed.choices)


def test_names_are_kept_as_written(language: Language) -> None:
    parsed = language.parse('Save this as "Monday Dmeo", then pause')
    assert isinstance(parsed, Understood)
    assert dump(parsed.actions) == [{"do": "save", "name": "Monday Dmeo"}, {"do": "pause"}]


def test_a_taught_phrase_holds_its_actions(language: Language) -> None:
    parsed = language.parse("when I say rush hour, I mean heavy traffic and ten more cars")
    assert isinstance(parsed, Understood)
    assert dump(parsed.actions) == [
        {
            "do": "teach",
            "phrase": "rush hour",
            "meaning": [
                {"do": "set", "parameter": "traffic", "value": "heavy"},
                {"do": "add", "kind": "vehicle", "count": 10},
            ],
        }
    ]
