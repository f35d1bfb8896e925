"""Converts a configuration to the actions that make it from the default one.

This is the inverse of `configured` and `setting`. The result is checked by applying it, so it is exact or an
error is raised. Settings that no action can change (size of a cell, reset delay, visible rows) have no
actions.
"""

from __future__ import annotations

from dataclasses import fields

from sim.actions import Prefer, Scenario, Set, WorldAction
from sim.config import Config
from sim.session.errors import EditError
from sim.session.scenario import ROADS, TRAFFIC, configured
from sim.session.settings import preferring, setting
from sim.world.layouts import has_barriers

_GROUND = ("columns", "rows", "seed")
_SET_AFTER = (
    "step_seconds",
    "spawn_probability",
    "pothole_probability",
    "courtesy",
    "attentive",
    "safety_buffer",
)


class UndescribableError(ValueError):
    """No actions make this configuration; `field` is the first setting that differs."""

    def __init__(self, field: str) -> None:
        super().__init__(f"nothing that can be said sets {field} so")
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
    now = configured(now, scenario)
    for name in _SET_AFTER:
        now = _set(now, name, config, actions)
    for wish in config.preferences:
        actions.append(Prefer(preference=wish))
        now = preferring(now, wish)
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
        after = setting(now, action)
    except EditError:
        raise UndescribableError(name) from None
    actions.append(action)
    return after


def _scenario(config: Config) -> Scenario:
    """Returns the scenario with the settings in which this configuration differs from its road preset."""
    preset = ROADS[config.road]
    spawn = preset.spawn_probability if config.traffic is None else TRAFFIC[config.traffic]
    # Setting a probability later replaces an exact number.
    vehicles = config.vehicles if config.spawn_probability == spawn else None
    potholes = config.potholes if config.pothole_probability == preset.pothole_probability else None
    barriers = 0 if has_barriers(config.layout) else preset.barriers
    return Scenario(
        road=config.road,
        layout=config.layout,
        traffic=config.traffic,
        potholes=potholes,
        vehicles=vehicles,
        barriers=None if config.barriers == barriers else config.barriers,
        pedestrians=None if config.pedestrians == preset.pedestrians else config.pedestrians,
        planner=None if config.planner == Config().planner else config.planner,  # type: ignore[arg-type]
        sensor=None if config.sensor == "perfect" else config.sensor,
    )
