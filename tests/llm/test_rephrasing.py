"""A model's words for an explanation are kept when they claim the same, and thrown away otherwise."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

from service.llm.claims import Claims
from service.llm.prompts import load_claims
from service.resources import prompts_folder
from tests.llm.conftest import Making
from tests.llm.server import HELD, Endpoint, Reply, reply, says

TEXT = (
    "At tick 12 I moved diagonally left, because vehicle-3 was about to enter the cell ahead and pothole-1 "
    "was in the cell to the right. Run again without vehicle-3, I go forward."
)
FACTS: dict[str, Any] = {
    "tick": 12,
    "causes": [{"id": "vehicle-3", "group": ["vehicle-3"]}, {"id": "pothole-1"}],
}
FAITHFUL = (
    "At tick 12, I went diagonally to the left: vehicle-3 was just entering the cell ahead of me, and "
    "pothole-1 lay in the cell on my right. When it is run again without vehicle-3, I drive straight on."
)


async def rephrased(endpoint: Endpoint, making: Making, answer: Reply, facts: dict[str, Any] = FACTS) -> str:
    endpoint.answers(answer)
    return await making(llm_rephrase=True).rephrase(TEXT, facts)


@pytest.mark.parametrize("answer", [FAITHFUL, TEXT, FAITHFUL.replace(". ", ".\n\n").replace("12", "twelve")])
async def test_faithful_words_are_kept(endpoint: Endpoint, making: Making, answer: str) -> None:
    assert await rephrased(endpoint, making, says(answer)) == " ".join(answer.split())


UNFAITHFUL = {
    "a changed number": FAITHFUL.replace("12", "13"),
    "a number more": FAITHFUL + " That saved 2 ticks.",
    "a number in words": FAITHFUL.replace("vehicle-3 was just", "two of us saw vehicle-3"),
    "a number less": FAITHFUL.replace("At tick 12, ", ""),
    "a changed id": FAITHFUL.replace("vehicle-3 was", "vehicle-4 was"),
    "an id more": FAITHFUL + " So did barrier-9.",
    "swapped ids": FAITHFUL.replace("vehicle-3 was", "X was")
    .replace("pothole-1", "vehicle-3")
    .replace("X", "pothole-1"),
    "an id less": FAITHFUL.replace("without vehicle-3", "without it"),
    "a changed move": FAITHFUL.replace("to the left", "to the right"),
    "a move less": FAITHFUL.replace("diagonally ", ""),
    "a move more": FAITHFUL + " Then I waited.",
    "moves swapped": FAITHFUL.replace("left", "Y").replace("right", "left").replace("Y", "right"),
    "a negation": FAITHFUL.replace("I went", "I didn't go").replace("I drive", "I do not drive"),
    "its negation lost": FAITHFUL.replace("without", "with"),
    "a thing more": FAITHFUL + " A child ran by.",
    "an opinion": FAITHFUL + " That was the safest way.",
    "the weather": FAITHFUL.replace(": vehicle-3", " in the rain: vehicle-3"),
    "a word of its own": FAITHFUL.replace(": vehicle-3", " amid aliens: vehicle-3"),
    "an address": FAITHFUL + " See http://evil.example/x",
    "a bare address": FAITHFUL + " See evil.example",
    "an address of harmless words": FAITHFUL.replace("of me,", "of me.it,"),
    "markup": FAITHFUL.replace("vehicle-3 was", "<b>vehicle-3</b> was"),
    "markdown": FAITHFUL.replace("vehicle-3 was", "**vehicle-3** was"),
    "letters that look alike": FAITHFUL.replace("I drive", "I n\u043et drive"),
    "a hidden mark": FAITHFUL.replace("without", "with\u200bout"),
    "far too long": FAITHFUL + " and so it was" * 50,
    "nothing": " \n",
    "a refusal": "I cannot help with that.",
}


@pytest.mark.parametrize("answer", UNFAITHFUL.values(), ids=UNFAITHFUL.keys())
async def test_unfaithful_words_are_thrown_away(endpoint: Endpoint, making: Making, answer: str) -> None:
    assert answer != FAITHFUL
    assert await rephrased(endpoint, making, says(answer)) == TEXT
    assert len(endpoint.bodies) == 1


@pytest.mark.parametrize("answer", [reply("{}", 500), reply("<html>", content_type="text/html"), says(None)])
async def test_a_broken_answer_changes_nothing(endpoint: Endpoint, making: Making, answer: Reply) -> None:
    assert await rephrased(endpoint, making, answer) == TEXT


async def test_a_slow_answer_changes_nothing(endpoint: Endpoint, making: Making) -> None:
    endpoint.answers(HELD)
    assert await making(llm_rephrase=True, llm_timeout_s=0.05).rephrase(TEXT, FACTS) == TEXT


async def test_ids_must_be_those_of_the_facts(endpoint: Endpoint, making: Making) -> None:
    assert await rephrased(endpoint, making, says(FAITHFUL), {"causes": [{"id": "pothole-1"}]}) == TEXT


async def test_nothing_is_asked_unless_it_is_set(endpoint: Endpoint, making: Making) -> None:
    endpoint.answers(says(FAITHFUL))
    assert await making().rephrase(TEXT, FACTS) == TEXT
    assert endpoint.bodies == []


async def test_the_text_travels_as_data(endpoint: Endpoint, making: Making) -> None:
    await rephrased(endpoint, making, says(FAITHFUL))
    system, user = endpoint.sent()
    assert (system["role"], user["role"]) == ("system", "user")
    assert TEXT not in system["content"]
    assert user["content"] == '{"explanation":"' + TEXT + '"}'


@pytest.mark.parametrize(
    ("text", "claims"),
    [
        ("3.50 m, 1,200 ticks", ["3.5", "metre", "1200", "tick"]),
        ("2 → 7.", ["2", "7"]),
        ("lane 2, row 5", ["lane", "2", "row", "5"]),
        ("1e+06", ["1000000"]),
        ("I couldn’t move left", ["could", "not", "left"]),
        ("Pothole-3 and POTHOLE-3", ["pothole-3", "pothole-3"]),
        ("I stayed; I waited", ["stay", "stay"]),
    ],
)
def test_what_is_claimed(text: str, claims: list[str]) -> None:
    assert [claim for _, claim in Claims.load().claims_in(text)] == claims


def test_no_word_makes_two_claims() -> None:
    values = load_claims()
    claiming = [word for group in values["groups"].values() for word in group]
    words = [*claiming, *values["numbers"], *values["neutral"]]
    assert all(isinstance(word, str) and word.replace("'", "").isalpha() and word.islower() for word in words)
    assert {word for word in words if words.count(word) > 1} == set()


@pytest.mark.parametrize(
    "saying", yaml.safe_load((prompts_folder() / "sayings/en/answers.yaml").read_text()).values()
)
def test_every_explanation_may_stand_as_it_is(saying: object) -> None:
    text = str(saying)
    assert Claims.load().is_faithful(text, text, {})
