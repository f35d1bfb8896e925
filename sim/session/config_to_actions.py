"""Converts a configuration to the actions that make it from the default one.

This is the inverse of `config_of_scenario` and `change_setting`. The result is checked by applying it, so it
is exact or an error is raised. Settings that no action can change (size of a cell, reset delay, visible rows)
have no actions.
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from sim.actions import Prefer, Scenario, Set, WorldAction
from sim.config import COUNTS, Config
from sim.sensor_names import DEFAULT_SENSOR
from sim.session.errors import EditError
from sim.session.scenario import ROADS, TRAFFIC, config_of_scenario, default_counts
from sim.session.settings import add_preference, change_setting
from sim.types import KINDS

_GROUND = ("columns", "rows", "seed")
_SET_AFTER = (
    "step_seconds",
    "spawn_probability",
    "pothole_probability",
    "courtesy",
    "attentive",
    "safety_buffer",
    "detection_sensitivity",
    "sensor_range_m",
    "sensor_noise",
    "false_positive_rate",
    "sensor_latency",
    "slip_probability",
    "traffic_by_hour",
)


class UndescribableError(ValueError):
    """No actions make this configuration; `field` is the first setting that differs."""

    def __init__(self, field: str) -> None:
        super().__init__(f"undescribable: {field}")
        self.field = field


def config_to_actions(config: Config) -> tuple[WorldAction, ...]:
    """Lists the actions that make this configuration from the default one. Raises `UndescribableError`."""
    now = Config()
    actions: list[WorldAction] = []
    for name in _GROUND:
        now = _set(now, name, config, actions)
    scenario = _scenario(config)
    if scenario != Scenario():
        actions.append(scenario)
    now = config_of_scenario(now, scenario)
    for name in _SET_AFTER:
        now = _set(now, name, config, actions)
    for wish in config.preferences:
        actions.append(Prefer(preference=wish))
        now = add_preference(now, wish)
    for field in fields(Config):
        if getattr(now, field.name) != getattr(config, field.name):
            raise UndescribableError(field.name)
    return tuple(actions)


def _set(now: Config, name: str, config: Config, actions: list[WorldAction]) -> Config:
    value = getattr(config, name)
    if getattr(now, name) == value:
        return now
    action = Set(parameter=name, value=value)  # type: ignore[arg-type]
    try:
        after = change_setting(now, action)
    except EditError:
        raise UndescribableError(name) from None
    actions.append(action)
    return after


def _scenario(config: Config) -> Scenario:
    """Returns the scenario with the settings in which this configuration differs from its road preset."""
    preset = ROADS[config.road]
    spawn = preset.spawn_probability if config.traffic is None else TRAFFIC[config.traffic]
    # Setting a probability later replaces an exact number.
    changed = set()
    if config.spawn_probability != spawn:
        changed.add("spawn_probability")
    if config.pothole_probability != preset.pothole_probability:
        changed.add("pothole_probability")
    counts: dict[str, Any] = {
        COUNTS[kind]: None if KINDS[kind].probability in changed else getattr(config, COUNTS[kind])
        for kind in COUNTS
    }
    default = default_counts(config.road, config.layout)
    counts = {name: None if count == default[name] else count for name, count in counts.items()}
    return Scenario(
        road=config.road,
        layout=config.layout,
        traffic=config.traffic,
        **counts,
        planner=None if config.planner == Config().planner else config.planner,  # type: ignore[arg-type]
        sensor=None if config.sensor == DEFAULT_SENSOR else config.sensor,  # type: ignore[arg-type]
        weather=None if config.weather == "clear" else config.weather,
        time_of_day=None if config.time_of_day == "day" else config.time_of_day,
    )
