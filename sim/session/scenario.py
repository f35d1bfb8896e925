"""From a scenario's words to a configuration: road presets and traffic levels, one table each.

A scenario renews what it can name (road, layout, traffic, counts, planner, sensor, weather, time of day) and
keeps the rest: the grid, the clock, the seed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from sim import sensor_names
from sim.actions import Layout, RoadType, Scenario, Traffic
from sim.config import COUNTS, Config, ConfigError, Problem
from sim.planner_names import PROMISED
from sim.rules.versions import default_under
from sim.types import KINDS, Kind
from sim.world.layouts import has_barriers


@dataclass(frozen=True, slots=True)
class RoadPreset:
    """What a type of road is furnished with where the scenario does not say."""

    spawn_probability: float
    pothole_probability: float
    counts: Mapping[Kind, int]
    """exact numbers, of kinds that no probability furnishes; none of the others"""


ROADS: Final[dict[RoadType | None, RoadPreset]] = {
    None: RoadPreset(spawn_probability=0.68, pothole_probability=0.15, counts={}),
    "highway": RoadPreset(spawn_probability=0.68, pothole_probability=0.05, counts={}),
    "city": RoadPreset(
        spawn_probability=0.55, pothole_probability=0.15, counts={Kind.PEDESTRIAN: 4, Kind.BARRIER: 3}
    ),
    "rural": RoadPreset(
        spawn_probability=0.30, pothole_probability=0.30, counts={Kind.PEDESTRIAN: 1, Kind.BARRIER: 1}
    ),
}

TRAFFIC: Final[dict[Traffic, float]] = {"none": 0.0, "light": 0.34, "normal": 0.68, "heavy": 0.90}
"""Spawn probability of an obstacle vehicle in each row."""

_PLANNER: Final = Config().planner


def find_unavailable(scenario: Scenario) -> Problem | None:
    """The first thing a scenario names that this version lacks; None if it has all."""
    if scenario.planner in PROMISED:
        return Problem("planner", "planner_not_available", value=scenario.planner)
    if scenario.avs:
        return Problem("avs", "second_vehicle_not_available")
    return None


def default_counts(road: RoadType | None, layout: Layout | None) -> dict[str, int | None]:
    """The counts of a scenario that names none, by field of `Config`; None: furnished by probability."""
    preset = ROADS[road].counts
    counts: dict[str, int | None] = {
        name: None if KINDS[kind].probability else preset.get(kind, 0) for kind, name in COUNTS.items()
    }
    if has_barriers(layout):
        counts[COUNTS[Kind.BARRIER]] = 0
    return counts


def config_of_scenario(config: Config, scenario: Scenario) -> Config:
    """The configuration of a scenario, everything it does not name at its default under the same rules.

    Raises `ConfigError` where the road cannot hold what was asked.
    """
    preset = ROADS[scenario.road]
    if has_barriers(scenario.layout) and scenario.barriers is not None:
        raise ConfigError((Problem("barriers", "must_not_be_counted", layout=scenario.layout),))
    counts = default_counts(scenario.road, scenario.layout)
    for name in counts:
        if (count := getattr(scenario, name)) is not None:
            counts[name] = count
    spawn = TRAFFIC[scenario.traffic] if scenario.traffic else preset.spawn_probability
    return config.with_parts(
        road=scenario.road,
        layout=scenario.layout,
        traffic=scenario.traffic,
        spawn_probability=spawn,
        pothole_probability=preset.pothole_probability,
        **counts,
        planner=scenario.planner or default_under(config.rules, "planner", _PLANNER),
        sensor=scenario.sensor or sensor_names.DEFAULT_SENSOR,
        weather=scenario.weather or "clear",
        time_of_day=scenario.time_of_day or "day",
    )
