"""Taught phrases that take numbers, and phrases that mean rules."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from service import actions as contract
from service.grammar import Understood
from service.store import SqlStore
from tests.interpreter.conftest import Json, Opening, Talk, english

LESSON = "when I say wall N, I mean N barriers in row 10"


def wall(count: int) -> Json:
    return {"do": "add", "kind": "barrier", "count": count, "where": {"row": 10}}


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("wall 5", [wall(5)]),
        ("wall five, please", [wall(5)]),
        ("add wall 2", [wall(2)]),
        ("add a cone and wall 4", [{"do": "add", "kind": "barrier", "count": 1}, wall(4)]),
        ("put a wall 5 m ahead", None),
    ],
)
async def test_the_number_said_stands_in_the_place_of_the_parameter(
    talk: Talk, text: str, meant: list[Json] | None
) -> None:
    told = await talk.say(LESSON)
    assert "add N barriers in row 10" in told["reply"]
    said = await talk.say(text)
    if meant is None:  # the language says this by itself
        meant = [{"do": "add", "kind": "barrier", "count": 1, "where": {"side": "ahead", "distance_m": 5.0}}]
    assert said["actions"] == meant


async def test_the_guide_names_the_parameters(talk: Talk) -> None:
    await talk.say(LESSON)
    (listed,) = (await talk.guide())["taught"]
    assert (listed["phrase"], listed["parameters"]) == ("wall N", ["N"])
    assert listed["sentence"] == "add N barriers in row 10"
    await talk.say("forget wall N")
    assert (await talk.guide())["taught"] == []


@pytest.mark.parametrize("text", ["wall 0", "wall 2.5", "wall", "wall -3"])
async def test_a_number_that_is_impossible_does_nothing(talk: Talk, text: str) -> None:
    await talk.say(LESSON)
    before = (await talk.state())["digest"]
    assert (await talk.post(text)).status_code == 422
    assert (await talk.state())["digest"] == before


async def test_a_phrase_with_numbers_outlasts_the_service(opening: Opening, tmp_path: Path) -> None:
    path = tmp_path / "phrases.sqlite"
    talk = await opening(SqlStore(f"sqlite:///{path}"))
    await talk.say(LESSON)
    await talk.stop()
    again = await opening(SqlStore(f"sqlite:///{path}"))
    assert (await again.say("wall 3"))["actions"] == [wall(3)]


@pytest.mark.parametrize(
    "text",
    [
        "when I say step N, I mean N cars",  # the language says that by itself
        "when I say seed N, I mean N cars",
        "when I say hop N, I mean jump N",
    ],
)
async def test_what_cannot_be_taught_is_refused(talk: Talk, text: str) -> None:
    assert (await talk.post(text)).status_code == 422
    assert (await talk.guide())["taught"] == []


@pytest.mark.parametrize(
    ("text", "meaning", "figures"),
    [
        (
            "when I say busy N, I mean every N ticks add a car",
            [
                {
                    "do": "trigger",
                    "when": {"fact": "every", "ticks": 2},
                    "then": [{"do": "add", "kind": "vehicle", "count": 1}],
                }
            ],
            {"N": ["0.when.ticks"]},
        ),
        (
            "when I say wall N in row K, I mean N barriers in row K",
            [{"do": "add", "kind": "barrier", "count": 2, "where": {"row": 3}}],
            {"N": ["0.count"], "K": ["0.where.row"]},
        ),
        (
            "when I say storm watch, I mean when it rains, use A*",
            [
                {
                    "do": "trigger",
                    "when": {"fact": "weather", "weather": "rain"},
                    "then": [{"do": "set", "parameter": "planner", "value": "astar"}],
                }
            ],
            {},
        ),
    ],
)
def test_lessons_are_read_and_said_back(
    text: str, meaning: list[Json], figures: dict[str, list[str]]
) -> None:
    parsed = english().parse(text)
    assert isinstance(parsed, Understood)
    (lesson,) = parsed.actions
    assert isinstance(lesson, contract.Teach)
    assert contract.dump(lesson.meaning) == meaning
    assert {each.name: list(each.figures) for each in lesson.parameters or ()} == figures
    again = english().parse(english().sentence(parsed.actions))
    assert isinstance(again, Understood)
    assert again.actions == parsed.actions


@pytest.mark.parametrize(
    "parameters",
    [
        [{"name": "N", "figures": ["0.kind"]}],
        [{"name": "N", "figures": ["3.count"]}],
        [{"name": "K", "figures": ["0.count"]}],
        [{"name": "wall", "figures": ["0.count"]}],
        [{"name": "N", "figures": ["0.count"]}, {"name": "n", "figures": ["0.count"]}],
    ],
)
def test_parameters_that_fit_nothing_are_refused(parameters: list[Json]) -> None:
    with pytest.raises(ValidationError):
        contract.load([{"do": "teach", "phrase": "wall N", "meaning": [wall(2)], "parameters": parameters}])
