"""Every fact is asked for by the sentence that is said back, in each language, and answered shortly."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import get_args

import pytest

from service.actions import Ask, FactName
from service.grammar import Language, Understood
from service.narration import Narrator
from service.narration.facts import DEPENDS, OTHERWISE
from service.narration.sayings import Sayings
from service.resources import prompts_folder
from service.sessions.facts import Asked
from sim.config import CHOICES, Config
from sim.planner_names import BUILT_IN
from sim.sensor_names import SensorName
from sim.session.timeline import Timeline
from sim.types import Mode, Outcome

CODES = ("en", "de")
MOST_WORDS = 60
TO_SAY = ("say", "ask", "sag", "frag")
"""Words before what a person may say."""
VALUES = {
    "planner": BUILT_IN,
    "sensor": get_args(SensorName),
    "weather": CHOICES["weather"],
    "time_of_day": CHOICES["time_of_day"],
    "mode": tuple(Mode),
    "outcome": tuple(Outcome),
}


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


@pytest.mark.parametrize("code", CODES)
def test_the_question_that_is_told_asks_for_the_fact(code: str) -> None:
    language, told = Language.load(code), Sayings.load(code).words("facts")
    for fact in get_args(FactName):
        question = told[fact]["question"]
        assert question.rstrip("?").casefold() == language.data.sentences["facts"][fact].casefold()
        parsed = language.parse(question)
        assert isinstance(parsed, Understood), question
        assert parsed.actions == (Ask(about="fact", fact=fact),)


@pytest.mark.parametrize("code", CODES)
def test_a_fact_is_told_shortly_and_has_no_place_left_open(code: str) -> None:
    for fact in get_args(FactName):
        for text in texts(code, fact):
            assert 1 <= len(text.split()) <= MOST_WORDS, text
            assert "{" not in text, text
            assert text[-1] in ".!?”“)", text


@pytest.mark.parametrize("code", CODES)
def test_what_a_fact_depends_on_is_told_for_every_value(code: str) -> None:
    for fact, entry in Sayings.load(code).words("facts").items():
        text = entry["text"]
        if isinstance(text, str):
            continue
        assert text["by"] in DEPENDS, fact
        told, values = set(text) - {"by", OTHERWISE}, {str(each) for each in VALUES[text["by"]]}
        assert told <= values, fact
        # Others may add planners of their own.
        assert OTHERWISE in text if text["by"] == "planner" else told == values or OTHERWISE in text, fact


@pytest.mark.parametrize("code", CODES)
def test_the_sentences_that_facts_tell_to_say_are_understood(code: str) -> None:
    language = Language.load(code)
    of_the_page = (prompts_folder() / "interface" / code / "page.yaml").read_text()
    for fact in get_args(FactName):
        for text in texts(code, fact):
            for lead, said in re.findall(r"(\w*) ?[“„]([^“”„]+)[”“]", text):
                if "…" not in said and (said[-1] == "?" or lead.casefold() in TO_SAY):
                    known = isinstance(language.parse(said), Understood) or said in of_the_page
                    assert known, (fact, said)


def test_the_answer_is_that_of_the_value_in_force() -> None:
    narrator = Narrator.load("en")
    by_planner = next(
        fact
        for fact in get_args(FactName)
        if isinstance(text := Sayings.load("en").words("facts", fact, "text"), dict)
        and text["by"] == "planner"
    )
    texts_of = Sayings.load("en").words("facts", by_planner, "text")
    for planner in BUILT_IN:
        timeline = Timeline(Config(planner=planner))
        answer = narrator.answer(Asked(Ask(about="fact", fact=by_planner), timeline))
        assert answer["text"] == texts_of.get(planner, texts_of.get(OTHERWISE))
