"""What is said in other words, of the road as it is, or cannot be done for a reason that is told."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from service.actions import Action, dump
from service.grammar import Language, Refused, Understood
from service.grammar.topic import Topic
from sim.actions import Add, Remove


class Road:
    """A road with six cars, three potholes and nothing else, in clear weather by day."""

    def count(self, kind: str) -> int:
        return {"vehicle": 6, "pothole": 3}.get(kind, 0)

    def value(self, parameter: str) -> int | float | str | None:
        values: Mapping[str, Any] = {
            "weather": "clear",
            "sensor": "camera",
            "sensor_noise": 0.1,
            "traffic": None,
        }
        return values.get(parameter)


NOW = Topic(now=Road())


@pytest.mark.parametrize(
    ("text", "kind", "count"),
    [
        ("double the traffic", "vehicle", 12),
        ("twice as many cars", "vehicle", 12),
        ("please triple the number of potholes", "pothole", 9),
        ("I want three times as many potholes", "pothole", 9),
        ("multiply the cars by 1.5", "vehicle", 9),
        ("add 50% more cars", "vehicle", 9),
        ("reduce the number of cars by 50 percent", "vehicle", 3),
        ("a third as many cars", "vehicle", None),
        ("double the pedestrians", "pedestrian", None),
        ("multiply the cars by 1000000", "vehicle", None),
        ("double the cars on the left", "vehicle", None),
        ("do not double the cars", "vehicle", None),
        ("did you double the cars?", "vehicle", None),
    ],
)
def test_so_many_times_what_there_is(language: Language, text: str, kind: str, count: int | None) -> None:
    parsed = language.parse(text, NOW)
    if count is None:
        assert isinstance(parsed, Refused)
    else:
        assert isinstance(parsed, Understood)
        assert dump(parsed.actions) == [{"do": "set_count", "kind": kind, "count": count}]


def set_back(parameter: str, value: object, ticks: int, old: object) -> list[dict[str, Any]]:
    """A setting changed now, and set back by a rule."""
    back = {"do": "set", "parameter": parameter, "value": old}
    rule = {"do": "trigger", "when": {"fact": "after", "ticks": ticks}, "then": [back]}
    return [{"do": "set", "parameter": parameter, "value": value}, rule]


@pytest.mark.parametrize(
    ("text", "actions"),
    [
        ("make it snow for 10 ticks", set_back("weather", "snow", 10, "clear")),
        ("for the next 5 ticks use radar", set_back("sensor", "radar", 5, "camera")),
        (
            "make it snow for 10 ticks and then add a car",
            [*set_back("weather", "snow", 10, "clear"), {"do": "add", "kind": "vehicle", "count": 1}],
        ),
        ("add a car and make it snow for 10 ticks", None),
        ("make the traffic heavy for 10 ticks", None),
        ("set the number of lanes to 5 for 10 ticks", None),
        ("add two cars for 10 ticks", None),
        ("make it clear for 10 ticks", None),
        ("make it snow for 10 ticks or so maybe never", None),
    ],
)
def test_a_setting_for_a_time_is_set_back(
    language: Language, text: str, actions: list[dict[str, Any]] | None
) -> None:
    parsed = language.parse(text, NOW)
    if actions is None and text.startswith("add a car and"):
        assert isinstance(parsed, Understood)
        assert [action.do for action in parsed.actions] == ["add", "set", "trigger"]
    elif actions is None:
        assert isinstance(parsed, Refused)
    else:
        assert isinstance(parsed, Understood)
        assert dump(parsed.actions) == actions


@pytest.mark.parametrize(
    ("changed", "undone", "done"),
    [
        ((Remove(kind="vehicle", count="all"),), False, True),
        ((Remove(kind="vehicle", count=2),), False, True),
        ((Remove(kind="pothole", count="all"),), False, False),
        ((Remove(kind="vehicle", count="all"), Add(kind="pothole", count=1)), False, False),
        ((Remove(kind="vehicle", count="all"),), True, False),
        ((), False, False),
    ],
)
def test_only_what_was_taken_away_last_is_brought_back(
    language: Language, changed: tuple[Action, ...], undone: bool, done: bool
) -> None:
    topic = Topic(changed=changed, changed_steps=1, undone=undone)
    for text in ("bring back the cars I removed", "put the cars back", "restore the cars"):
        parsed = language.parse(text, topic)
        if done:
            assert isinstance(parsed, Understood)
            assert dump(parsed.actions) == [{"do": "undo"}]
        else:
            assert isinstance(parsed, Refused)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("zoom in a bit", "picture"),
        ("clear the road but leave the pedestrians", "remove everything except the pedestrians"),
        ("remove all the cars except two", "exactly 2 cars"),
        ("make the pedestrians faster", "fixed"),
        ("freeze the cars", "pause"),
        ("turn that car around", "cannot be chosen"),
        ("add a car that drives left in row 5", "cannot be chosen"),
        ("add 2.5 potholes", "whole numbers"),
        ("add -3 potholes", "least is 1"),
        ("add 1000000 cars", "most is 10,000"),
        ("don't add any more cars", "remove all cars"),
        ("no pedestrians please", "remove all pedestrians"),
        ("hide the forecast", "page"),
        ("make it snow for 10 ticks", "Say both"),
        ("double the cars", "session"),
        ("add a car and zoom in", "picture"),
        ("same again with seed 4", "start over with seed 4"),
    ],
)
def test_what_cannot_be_done_is_refused_with_its_reason(language: Language, text: str, told: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert told in parsed.message
    assert "Nothing was changed" in parsed.message


def test_what_the_reasons_propose_can_be_said(language: Language) -> None:
    said = [
        "remove all cars",
        "remove everything except the pedestrians",
        "there should be exactly 2 cars",
        "stop adding cars",
        "make it clear",
        "pause",
        "undo",
        "undo the last two changes",
        "replace the cars with barriers",
        "drive slower",
        "add a car in row 5",
        "start over",
        "rewind to tick 12",
        "start over with seed 4",
        "add five potholes in lanes 1 to 2",
        "in 10 ticks make it clear",
        "add two cars",
    ]
    assert [text for text in said if not isinstance(language.parse(text), Understood)] == []
