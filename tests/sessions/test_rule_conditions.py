"""What rules wait for: weather, time of day, the goal, what is ahead, and no longer being so."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from service import actions as contract
from sim.actions import Condition
from sim.config import Config
from sim.session.conditions import is_so, nearest_m
from tests.support.session_talk import anew
from tests.support.sessions import Service, do

RAIN = {"do": "set", "parameter": "weather", "value": "rain"}
CLEAR = {"do": "set", "parameter": "weather", "value": "clear"}
CONE = {"do": "add", "kind": "barrier", "count": 1}
STEP = {"do": "step", "ticks": 1}


def rule(then: dict[str, Any], **when: Any) -> dict[str, Any]:
    return {"do": "trigger", "when": when, "then": [then]}


async def test_a_rule_is_done_when_the_weather_changes_and_once_for_each_change() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, rule(CONE, fact="weather", weather="rain"))
    fired = []
    for action in (STEP, RAIN, STEP, STEP, CLEAR, STEP, RAIN, STEP):
        await do(session, action)
        fired.append(session.run.triggers.standing[0].fired)
    assert fired == [0, 0, 1, 1, 1, 1, 1, 2]
    assert anew(session) == session.run


async def test_a_setting_that_is_so_already_waits_for_the_next_time() -> None:
    session = await Service().session(Config(seed=3, weather="rain"), paused=True)
    reply = await do(session, rule(CONE, fact="weather", weather="rain"))
    assert reply.startswith("Rule 1: when it rains: add 1 barrier. That is so already:")
    await do(session, STEP)
    assert session.run.triggers.standing[0].fired == 0


async def test_what_is_no_longer_so_is_waited_for() -> None:
    session = await Service().session(Config(seed=3, time_of_day="night"), paused=True)
    reply = await do(session, rule(CONE, fact="time_of_day", time_of_day="night", no_longer=True))
    assert reply == "Rule 1: when it is no longer night: add 1 barrier."
    await do(session, STEP)
    await do(session, {"do": "set", "parameter": "time_of_day", "value": "day"})
    await do(session, STEP)
    assert session.run.triggers.standing[0].fired == 1


async def test_the_weather_is_not_new_with_each_road() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, rule({"do": "pause"}, fact="weather", weather="rain"))
    await do(session, RAIN)
    for _ in range(6):
        await do(session, {"do": "step", "ticks": 100})
    assert session.run.world.episode > 1
    assert session.run.triggers.standing[0].fired == 1


async def test_the_goal_is_as_far_as_there_are_rows() -> None:
    session = await Service().session(Config(seed=3), paused=True)
    await do(session, rule({"do": "pause"}, fact="goal", closer_than_m=30.0))
    await do(session, {"do": "step", "ticks": 200})
    assert session.run.world.road.cell(session.run.world.av)[1] * session.run.config.cell_m == 25.0


async def test_ahead_and_behind_are_the_lane_of_the_vehicle() -> None:
    session = await Service().session(Config(seed=3, potholes=0, vehicles=0), paused=True)
    world = session.run.world
    column, row = world.road.cell(world.av)
    assert nearest_m(world, None, 5.0, "ahead") is None
    for cell in ([column, row - 3], [column + 1, row - 1]):
        await do(session, {"do": "add", "kind": "pothole", "count": 1, "where": {"cell": cell}})
    world = session.run.world
    assert nearest_m(world, None, 5.0, "ahead") == 15.0
    assert nearest_m(world, None, 5.0, "behind") is None
    assert nearest_m(world, None, 5.0) == 5.0
    assert is_so(Condition(fact="near", side="ahead", within_m=15.0), session.run)
    assert not is_so(Condition(fact="near", side="ahead", within_m=10.0), session.run)
    assert is_so(Condition(fact="near", side="behind", farther_than_m=10.0), session.run)


@pytest.mark.parametrize(
    "when",
    [
        {"fact": "weather"},
        {"fact": "weather", "weather": "hail"},
        {"fact": "weather", "weather": "rain", "no_longer": False},
        {"fact": "row", "row": 3, "no_longer": True},
        {"fact": "goal", "farther_than_m": 3.0},
        {"fact": "near", "side": "left", "within_m": 3.0},
    ],
)
def test_conditions_that_make_no_sense_are_refused(when: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        contract.load([{"do": "trigger", "when": when, "then": [{"do": "pause"}]}])
