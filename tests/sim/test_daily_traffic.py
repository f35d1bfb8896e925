"""Traffic by the time of day: off unless asked for, fewer cars at night, and no other cars than by day."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Adjust, Set, TimeOfDay
from sim.batch.batch import Batch
from sim.config import Config, ConfigError
from sim.daily_traffic import DAILY_TRAFFIC, vehicle_probability
from sim.generation import generate
from sim.perceive.belief import density
from sim.session.config_to_actions import config_to_actions
from sim.session.edits import apply
from sim.session.settings import change_setting, vehicles_for
from sim.state import SimState
from sim.types import Kind

HOURS = get_args(TimeOfDay)


def vehicles(seed: int, **parts: object) -> int:
    return generate(Config(seed=seed).with_parts(**parts), 1).board(Kind.VEHICLE)


@pytest.mark.parametrize("hour", HOURS)
def test_by_default_every_hour_has_the_roads_of_the_day(hour: TimeOfDay) -> None:
    assert all(vehicles(seed, time_of_day=hour) == vehicles(seed) for seed in range(20))
    assert Config(time_of_day=hour).vehicle_probability == Config().spawn_probability


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.sampled_from(HOURS))
def test_it_is_a_probability_between_that_of_the_day_and_that_of_the_hour(
    spawn: float, share: float, hour: TimeOfDay
) -> None:
    found, whole = (vehicle_probability(spawn, hour, each) for each in (share, 1.0))
    assert 0.0 <= found <= 1.0
    assert min(spawn, whole) - 1e-12 <= found <= max(spawn, whole) + 1e-12
    assert whole == pytest.approx(min(1.0, spawn * DAILY_TRAFFIC[hour]))


@settings(max_examples=40)
@given(st.integers(0, 2**50))
def test_cars_come_or_go_and_none_is_elsewhere(seed: int) -> None:
    night, dawn, day, dusk = (
        vehicles(seed, time_of_day=hour, traffic_by_hour=1.0) for hour in ("night", "dawn", "day", "dusk")
    )
    assert night & dawn == night
    assert dawn & day == dawn
    assert day & dusk == day
    assert day == vehicles(seed)


def test_there_are_as_many_as_the_factors_say() -> None:
    def mean(hour: str) -> float:
        return sum(vehicles(s, time_of_day=hour, traffic_by_hour=1.0).bit_count() for s in range(300)) / 300

    for hour in HOURS:
        assert mean(hour) == pytest.approx(28 * 0.68 * DAILY_TRAFFIC[hour], abs=0.6)


def test_exact_numbers_stay() -> None:
    exact = {"vehicles": 12, "pedestrians": 5, "time_of_day": "night", "traffic_by_hour": 1.0}
    world = generate(Config(seed=3).with_parts(**exact), 1)
    assert world.count(Kind.VEHICLE) == 12
    assert world.count(Kind.PEDESTRIAN) == 5


@pytest.mark.xdist_group("compiled")
def test_a_batch_draws_the_same_roads() -> None:
    configs = [
        Config(seed=seed, time_of_day=hour, traffic_by_hour=share)
        for seed, (hour, share) in enumerate([("night", 1.0), ("dusk", 0.5), ("dawn", 0.0), ("day", 1.0)])
    ]
    batch = Batch(configs)
    for lane, config in enumerate(configs):
        assert batch.digest(lane) == generate(config, 1).digest()


def test_what_is_expected_of_a_road_follows() -> None:
    """The prior of sensors, and the number that an answer tells."""
    night = Config(time_of_day="night", traffic_by_hour=1.0)
    assert density(night, Kind.VEHICLE) == pytest.approx(0.3 * density(Config(), Kind.VEHICLE))
    assert vehicles_for(night) == round(0.3 * 28 * 0.68)


def test_it_is_set_like_any_number_and_leaves_the_road_as_it_is() -> None:
    state = SimState.start(Config(seed=5, time_of_day="night"))
    after = apply(state, Set(parameter="traffic_by_hour", value=1)).state
    assert after.config.traffic_by_hour == 1
    assert after.world == state.world
    more = change_setting(Config(), Adjust(parameter="traffic_by_hour", direction="up"))
    assert more.traffic_by_hour == 0.25
    config = Config(time_of_day="dusk", traffic_by_hour=0.5)
    now = replace(state, config=Config(rules=config.rules))
    for action in config_to_actions(config):
        now = apply(now, action).state
    assert now.config == config


@pytest.mark.parametrize("value", [-0.1, 1.1, True, "much"])
def test_it_is_a_share(value: object) -> None:
    with pytest.raises(ConfigError):
        Config().with_parts(traffic_by_hour=value)
