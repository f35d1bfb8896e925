"""Settings that can be changed while a road runs, and what a change by a step means.

There are three kinds. Some hold from the next decision on. Some are what roads are made from: they show from
the next road on, a restart included. `NEEDS_A_NEW_ROAD` lists those that begin a new road. Settings that this
version lacks are refused, unless the value asked for is the only one there is.
"""

from __future__ import annotations

from typing import Any, Final, get_args

from sim.actions import Adjust, Preference, Set, Traffic, Wish
from sim.config import COUNTS, RANGES, Config, ConfigError
from sim.planner_names import PROMISED
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.session.errors import EditError
from sim.session.scenario import TRAFFIC
from sim.types import KINDS, Kind
from sim.world.layouts import vehicles_on_average

NEEDS_A_NEW_ROAD: Final = frozenset(("columns", "rows", "seed"))
FROM_THE_NEXT_ROAD: Final = frozenset(
    ("spawn_probability", "pothole_probability", "traffic", "traffic_by_hour")
)
STEPS: Final[dict[str, float]] = {
    "spawn_probability": 0.1,
    "pothole_probability": 0.05,
    "courtesy": 0.1,
    "attentive": 0.1,
    "safety_buffer": 1,
    "detection_sensitivity": 0.1,
    "sensor_range_m": 10,
    "sensor_noise": 0.05,
    "false_positive_rate": 0.05,
    "sensor_latency": 1,
    "slip_probability": 0.05,
    "traffic_by_hour": 0.25,
    "step_seconds": 0.1,
    "columns": 1,
    "rows": 5,
    "seed": 1,
}
"""How far "up" and "down" go, for every number that can be set."""
CHOSEN: Final = frozenset(("planner", "sensor", "weather", "time_of_day"))
"""Settings with words for values, which hold from the next decision on."""
AS_IT_IS: Final = {"dynamics": DEFAULT_DYNAMICS}
"""Settings that this version has in one form only."""
_COUNTS: Final = {
    **{probability: name for kind, name in COUNTS.items() if (probability := KINDS[kind].probability)},
    "traffic": COUNTS[Kind.VEHICLE],
}
"""Exact numbers that a probability takes the place of."""
_LEVELS: Final = get_args(Traffic)


def is_available(action: Set | Adjust) -> bool:
    """Whether this version can change such a setting at all, whatever the value."""
    name = action.parameter
    if name in AS_IT_IS:
        return isinstance(action, Set) and action.value == AS_IT_IS[name]
    if name == "planner":
        return isinstance(action, Adjust) or action.value not in PROMISED
    return name in STEPS or name in CHOSEN or name == "traffic"


def change_setting(config: Config, action: Set | Adjust) -> Config:
    """The configuration with a setting changed. Raises `EditError`."""
    name = action.parameter
    if not is_available(action):
        raise EditError("setting_not_available", "parameter", setting=name)
    if name in AS_IT_IS:
        return config
    value = action.value if isinstance(action, Set) else _adjusted_value(config, action)
    parts: dict[str, Any] = {name: value}
    if name == "traffic":
        if value not in _LEVELS:
            raise EditError("no_such_traffic", "value", choices=_LEVELS)
        parts["spawn_probability"] = TRAFFIC[value]  # type: ignore[index]
    elif name == "spawn_probability":
        parts["traffic"] = None
    if name in _COUNTS:
        parts[_COUNTS[name]] = None
    if isinstance(value, float) and value.is_integer() and isinstance(getattr(config, name), int):
        parts[name] = int(value)
    try:
        return config.with_parts(**parts)
    except ConfigError as error:
        problem = error.problems[0]
        now = getattr(config, problem.field)
        raise EditError("value_refused", "value", setting=problem.field, problem=problem, now=now) from None


def add_preference(config: Config, wish: Wish) -> Config:
    """The configuration with one more preference, the latest last; `balanced` clears them."""
    return config.with_parts(preferences=preferences_with(config.preferences, wish))


def preferences_with(preferences: tuple[Preference, ...], wish: Wish) -> tuple[Preference, ...]:
    """The preferences with one more, the latest last; `balanced` clears them."""
    if wish == "balanced":
        return ()
    opposite: dict[Preference, Preference] = {"fastest": "cautious", "cautious": "fastest"}
    kept = [other for other in preferences if other not in (wish, opposite.get(wish))]
    return (*kept, wish)


def vehicles_for(config: Config) -> int:
    """How many obstacle vehicles a road of this traffic has on average."""
    return round(vehicles_on_average(config.layout, config.columns, config.rows, config.vehicle_probability))


def _adjusted_value(config: Config, action: Adjust) -> object:
    name = action.parameter
    if name == "traffic":
        return _next_level(config, action)
    if name not in STEPS:
        raise EditError("no_more_or_less", "parameter", setting=name)
    now = getattr(config, name)
    if action.factor is not None:
        return round(now * action.factor, 9)
    if action.by is not None:
        return round(now + action.by, 9)
    low, high = RANGES[name]
    if now == (high if action.direction == "up" else low):
        raise EditError("at_its_limit", "direction", setting=name, now=now)
    step = STEPS[name] if action.direction == "up" else -STEPS[name]
    return round(min(high, max(low, now + step)), 9)


def _next_level(config: Config, action: Adjust) -> str:
    if action.direction is None:
        raise EditError("traffic_by_steps_only", "parameter", choices=_LEVELS)
    now = config.traffic or "normal"
    index = _LEVELS.index(now) + (1 if action.direction == "up" else -1)
    if not 0 <= index < len(_LEVELS):
        raise EditError("at_its_limit", "direction", setting="traffic", now=now)
    return str(_LEVELS[index])
