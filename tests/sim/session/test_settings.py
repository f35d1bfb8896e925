"""Settings changed while a road runs: what they do, when they show, and what is refused."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.actions import Adjust, Prefer, Set
from sim.config import RANGES, Config
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.settings import STEPS
from sim.session.timeline import Timeline
from sim.state import SimState, next_episode
from sim.transition import step
from sim.types import Kind

RUN = SimState.start(Config(seed=6, potholes=4))


def after(state: SimState, parameter: str, value: Any) -> SimState:
    return apply(state, Set(parameter=parameter, value=value)).state  # type: ignore[arg-type]


def test_a_planner_takes_the_wheel_at_the_next_decision() -> None:
    changed = after(RUN, "planner", "astar")
    assert changed.world == RUN.world
    decision = step(changed).decision
    assert decision is not None
    assert decision.planner == "astar"


def test_heavy_traffic_is_heavy_now_and_later() -> None:
    done = apply(RUN, Set(parameter="traffic", value="heavy"))
    assert done.state.world.count(Kind.VEHICLE) == 25  # 0.9 of 28 rows
    assert done.state.world.fixed == RUN.world.fixed
    assert {change.path for change in done.changes} == {
        "vehicles",
        "config.traffic",
        "config.spawn_probability",
    }
    later = next_episode(done.state)[0]
    assert later.config.spawn_probability == 0.9


def test_probabilities_show_from_the_next_road_on() -> None:
    changed = after(RUN, "pothole_probability", 1.0)
    assert changed.world == RUN.world
    assert next_episode(changed)[0].world.count(Kind.POTHOLE) == 28


@pytest.mark.parametrize(("parameter", "value"), [("rows", 40), ("columns", 5), ("seed", 99)])
def test_what_only_a_new_road_can_have_begins_one(parameter: str, value: int) -> None:
    changed = after(RUN, parameter, value)
    assert getattr(changed.config, parameter) == value
    assert changed.world.episode == RUN.world.episode + 1
    same = after(RUN, parameter, getattr(RUN.config, parameter))
    assert same == RUN


@pytest.mark.parametrize(
    ("action", "category"),
    [
        (Set(parameter="courtesy", value=1.5), "out-of-range"),
        (Set(parameter="courtesy", value="much"), "out-of-range"),
        (Set(parameter="rows", value=2), "out-of-range"),
        (Set(parameter="rows", value=30.5), "out-of-range"),
        (Set(parameter="planner", value="telepathy"), "out-of-range"),
        (Set(parameter="planner", value="dwa"), "not-available"),
        (Set(parameter="traffic", value="mad"), "out-of-range"),
        (Set(parameter="weather", value="hail"), "out-of-range"),
        (Set(parameter="time_of_day", value="noon"), "out-of-range"),
        (Set(parameter="sensor", value="sonar"), "out-of-range"),
        (Adjust(parameter="weather", direction="up"), "out-of-range"),
        (Set(parameter="dynamics", value="continuous"), "not-available"),
        (Set(parameter="target_speed_kmh", value=40), "not-available"),
        (Set(parameter="sensor_range_m", value=4), "out-of-range"),
        (Set(parameter="sensor_noise", value=0.6), "out-of-range"),
        (Adjust(parameter="false_positive_rate", by=-0.1), "out-of-range"),
        (Adjust(parameter="safety_buffer", by=9), "out-of-range"),
        (Adjust(parameter="courtesy", direction="down"), "out-of-range"),
        (Adjust(parameter="planner", direction="up"), "out-of-range"),
        (Adjust(parameter="traffic", factor=2.0), "out-of-range"),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused(action: Set | Adjust, category: str) -> None:
    with pytest.raises(EditError) as raised:
        apply(RUN, action)
    assert raised.value.category == category


@pytest.mark.parametrize("value", ["perfect", "clear", "day", "grid"])
def test_what_is_so_already_is_no_change(value: str) -> None:
    parameter = {"perfect": "sensor", "clear": "weather", "day": "time_of_day", "grid": "dynamics"}[value]
    assert after(RUN, parameter, value) == RUN


@given(st.sampled_from(sorted(STEPS)), st.integers(1, 8), st.sampled_from(["up", "down"]))
def test_steps_stay_within_the_range(parameter: str, times: int, direction: Any) -> None:
    state, (low, high) = RUN, RANGES[parameter]
    for _ in range(times):
        try:
            state = apply(state, Adjust(parameter=parameter, direction=direction)).state  # type: ignore[arg-type]
        except EditError:
            assert getattr(state.config, parameter) == (high if direction == "up" else low)
            break
        assert low <= getattr(state.config, parameter) <= high


def test_factors_and_amounts() -> None:
    config = apply(RUN, Adjust(parameter="spawn_probability", factor=0.5)).state.config
    assert config.spawn_probability == 0.34
    assert apply(RUN, Adjust(parameter="safety_buffer", by=1)).state.config.safety_buffer == 2


def test_preferences_gather_and_are_cleared() -> None:
    state = RUN
    for wish in ("avoid_potholes", "cautious", "smooth_ride", "fastest", "avoid_potholes"):
        state = apply(state, Prefer(preference=wish)).state  # type: ignore[arg-type]
    assert state.config.preferences == ("smooth_ride", "fastest", "avoid_potholes")
    assert apply(state, Prefer(preference="balanced")).state.config.preferences == ()


def test_settings_are_part_of_what_is_replayed() -> None:
    timeline = Timeline(Config(seed=2))
    said = [
        Set(parameter="planner", value="astar"),
        Prefer(preference="cautious"),
        Set(parameter="traffic", value="heavy"),
        Adjust(parameter="rows", direction="up"),
    ]
    for number, action in enumerate(said, 1):
        timeline.advance()
        timeline.apply(number, [action])
    for _ in range(5):
        timeline.advance()
    now = timeline.state
    timeline.rewrite(list(timeline.entries), 0)
    assert timeline.state == now
    timeline.rewrite(timeline.entries[:1], 2)
    assert timeline.state.config.preferences == ()
