"""Scenarios: the presets do what their words say, and what is not named is at its default."""

from __future__ import annotations

import pytest

from sim.actions import RoadType, Scenario, Traffic
from sim.config import Config, ConfigError
from sim.session.scenario import ROADS, TRAFFIC, config_of_scenario
from sim.types import Kind

USED = Config(
    columns=6,
    rows=20,
    cell_m=4.0,
    seed=11,
    potholes=9,
    vehicles=3,
    barriers=5,
    pedestrians=6,
    road="city",
    traffic="heavy",
)


def test_what_is_not_named_is_at_its_default_but_the_grid_the_clock_and_the_seed_are_kept() -> None:
    assert config_of_scenario(USED, Scenario()) == Config(columns=6, rows=20, cell_m=4.0, seed=11)


def test_numbers_said_are_exact() -> None:
    config = config_of_scenario(USED, Scenario(potholes=10, vehicles=0, barriers=1, pedestrians=0))
    assert (config.potholes, config.vehicles, config.barriers, config.pedestrians) == (10, 0, 1, 0)


@pytest.mark.parametrize("road", [road for road in ROADS if road is not None])
def test_a_type_of_road_brings_its_furniture(road: RoadType) -> None:
    config, preset = config_of_scenario(Config(), Scenario(road=road)), ROADS[road]
    assert config.road == road
    assert (config.spawn_probability, config.pothole_probability) == (
        preset.spawn_probability,
        preset.pothole_probability,
    )
    assert (config.pedestrians, config.barriers) == tuple(
        preset.counts.get(kind, 0) for kind in (Kind.PEDESTRIAN, Kind.BARRIER)
    )
    bare = config_of_scenario(Config(), Scenario(road=road, pedestrians=0, barriers=0))
    assert (bare.pedestrians, bare.barriers) == (0, 0)


def test_the_presets_differ_as_their_words_do() -> None:
    city, rural, highway = (
        ROADS[road].counts.get(Kind.PEDESTRIAN, 0) for road in ("city", "rural", "highway")
    )
    assert city > rural > highway == 0
    assert ROADS["rural"].pothole_probability > ROADS["city"].pothole_probability
    assert ROADS["city"].pothole_probability > ROADS["highway"].pothole_probability
    default = Config()
    assert ROADS[None].spawn_probability == default.spawn_probability
    assert ROADS[None].pothole_probability == default.pothole_probability


@pytest.mark.parametrize(("traffic", "probability"), list(TRAFFIC.items()))
def test_traffic_overrides_what_the_road_brings(traffic: Traffic, probability: float) -> None:
    assert (
        config_of_scenario(Config(), Scenario(road="rural", traffic=traffic)).spawn_probability == probability
    )


def test_traffic_levels_rise() -> None:
    assert list(TRAFFIC) == ["none", "light", "normal", "heavy"]
    assert list(TRAFFIC.values()) == sorted(TRAFFIC.values())
    assert TRAFFIC["none"] == 0
    assert TRAFFIC["normal"] == Config().spawn_probability


def test_a_scenario_the_road_cannot_hold_is_refused() -> None:
    with pytest.raises(ConfigError) as refused:
        config_of_scenario(Config(), Scenario(potholes=300))
    assert [problem.field for problem in refused.value.problems] == ["potholes"]
