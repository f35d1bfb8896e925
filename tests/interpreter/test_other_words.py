"""Requests in other words that depend on the road as it is, or on what was said before."""

from __future__ import annotations

from typing import Any

import pytest

from tests.interpreter.conftest import Json, Talk


def count(kind: str, number: int) -> list[Json]:
    return [{"do": "set_count", "kind": kind, "count": number}]


async def config(talk: Talk) -> Json:
    """The settings of the session."""
    return (await talk.client.get(talk.path)).json()["config"]  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    ("turns", "meant"),
    [
        (["exactly 4 cars", "double the traffic"], count("vehicle", 8)),
        (["exactly 4 cars", "double the cars", "exactly 6 cars", "double the cars"], count("vehicle", 12)),
        (["exactly 4 cars", "add 50% more cars"], count("vehicle", 6)),
        (["add a cone", "remove the last thing I added"], None),
        (["add a car", "add a cone", "remove the last thing that I just put down"], None),
        (["add a pothole in lane 3", "add another one there"], None),
        (["add two cones", "two more"], [{"do": "add", "kind": "barrier", "count": 2}]),
        (["remove two cars", "put them back"], [{"do": "undo"}]),
        (["exactly 4 cars", "remove all cars", "bring back the cars I removed"], [{"do": "undo"}]),
        (["remove all cars", "use A*", "undo", "bring back the cars I removed"], "refused"),
        (["remove all potholes", "bring back the cars I removed"], "refused"),
        (["remove all cars", "double the cars"], "refused"),
        (["make it snow", "make it snow for 5 ticks"], "refused"),
        (["add a car", "add a car in lane 3 and a cone behind it"], "refused"),
    ],
)
async def test_the_last_turn(talk: Talk, turns: list[str], meant: Any) -> None:
    for turn in turns[:-1]:
        await talk.say(turn)
    if meant == "refused":
        await talk.refused(turns[-1])
        return
    before = await talk.ids()
    said = await talk.say(turns[-1])
    if meant is not None:
        assert said["actions"] == meant
    elif turns[-1].startswith("remove"):
        assert before - await talk.ids() == {"barrier-1"}
    else:
        (action,) = said["actions"]
        assert (action["do"], action["kind"], action["where"]) == ("add", "pothole", {"lane": 3})


async def test_weather_for_a_time_is_set_back_by_itself(talk: Talk) -> None:
    await talk.say("make it snow for 3 ticks")
    await talk.say("step 2 ticks")
    assert (await config(talk))["weather"] == "snow"
    await talk.say("step 2 ticks")
    assert (await config(talk))["weather"] == "clear"


async def test_starting_over_keeps_the_weather_and_takes_the_seed(talk: Talk) -> None:
    await talk.say("make it rain")
    await talk.say("reset but keep the weather")
    assert (await config(talk))["weather"] == "rain"
    await talk.say("start over with seed 4")
    assert (await config(talk))["seed"] == 4
    before = (await talk.state())["hazards"]
    await talk.say("restart with a new seed")
    now = await config(talk)
    assert (now["seed"], now["weather"]) == (5, "rain")
    assert (await talk.state())["hazards"] != before
