"""A configuration as actions: what would have to be said, on a new road, to get it.

Inverts `config_of_scenario` and `change_setting`; the result is checked by applying it, so it is exact or not
given. Omits what nothing that can be said changes (cell size, reset delay, what is visible).
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from sim.actions import Prefer, Scenario, Set, WorldAction
from sim.config import COUNTS, Config
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
)


class UndescribableError(ValueError):
    """Nothing that can be said makes this configuration; `field` is the first that differs."""

    def __init__(self, field: str) -> None:
        super().__init__(f"undescribable: {field}")
        self.field = field


def config_to_actions(config: Config) -> tuple[WorldAction, ...]:
    """Actions that make this configuration of the default one, in order. Raises `UndescribableError`."""
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
    """The scenario that names what this configuration has and its road has not by itself."""
    preset = ROADS[config.road]
    spawn = preset.spawn_probability if config.traffic is None else TRAFFIC[config.traffic]
    # A probability that is set later takes the place of an exact number.
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
        sensor=None if config.sensor == "perfect" else config.sensor,  # type: ignore[arg-type]
    )
