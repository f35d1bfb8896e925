"""Every fact is asked for by the sentence that is said back, in each language, and answered shortly."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

import pytest

from service.actions import Ask, FactName
from service.grammar import Language, Understood
from service.narration import Narrator
from service.narration.facts import DEPENDS, OTHERWISE
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import CHOICES, Config
from sim.session.timeline import Timeline
from sim.types import Mode, Outcome

CODES = ("en", "de")
MOST_WORDS = 60
VALUES = {**CHOICES, "mode": tuple(Mode), "outcome": tuple(Outcome)}


def texts(code: str, fact: str) -> Iterator[str]:
    """Each text that a fact may be told with."""
    text = Sayings.load(code).words("facts", fact, "text")
    if isinstance(text, str):
        yield text
    else:
        yield from (each for key, each in text.items() if key != "by")


@pytest.mark.parametrize("code", CODES)
def test_the_sayings_and_the_phrases_are_of_the_same_facts(code: str) -> None:
    names = set(get_args(FactName))
    assert set(Language.load(code).data.sentences["facts"]) == names
    assert set(Sayings.load(code).words("facts")) == names
    assert set(Sayings.load(code).words("facts")) == names


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("fact", get_args(FactName))
def test_the_question_that_is_told_asks_for_the_fact(code: str, fact: FactName) -> None:
    language, question = Language.load(code), Sayings.load(code).words("facts", fact, "question")
    said_back = language.data.sentences["facts"][fact]
    assert question.rstrip("?").casefold() == said_back.casefold()
    parsed = language.parse(question)
    assert isinstance(parsed, Understood), question
    assert parsed.actions == (Ask(about="fact", fact=fact),)


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("fact", get_args(FactName))
def test_a_fact_is_told_shortly_and_has_no_place_left_open(code: str, fact: FactName) -> None:
    for text in texts(code, fact):
        assert 1 <= len(text.split()) <= MOST_WORDS, text
        assert "{" not in text, text
        assert text[-1] in ".!?”“)", text


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("fact", get_args(FactName))
def test_what_a_fact_depends_on_is_told_for_every_value(code: str, fact: FactName) -> None:
    text = Sayings.load(code).words("facts", fact, "text")
    if isinstance(text, str):
        return
    assert text["by"] in DEPENDS
    told, values = set(text) - {"by", OTHERWISE}, {str(each) for each in VALUES[text["by"]]}
    assert told <= values
    assert told == values or OTHERWISE in text


def test_the_answer_is_that_of_the_value_in_force() -> None:
    narrator = Narrator.load("en")
    by_planner = next(
        fact
        for fact in get_args(FactName)
        if isinstance(text := Sayings.load("en").words("facts", fact, "text"), dict)
        and text["by"] == "planner"
    )
    texts_of = Sayings.load("en").words("facts", by_planner, "text")
    for planner in CHOICES["planner"]:
        timeline = Timeline(Config(planner=planner))
        answer = narrator.answer(Asked(Ask(about="fact", fact=by_planner), timeline))
        assert answer["text"] == texts_of.get(planner, texts_of.get(OTHERWISE))
