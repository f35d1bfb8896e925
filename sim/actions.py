"""What may be done to a world: the actions that a session's log is made of.

Plain dataclasses, one per `do` of the language contract, so that the rules need no validation
library; the service checks incoming JSON against these same classes (`service.actions` adds
the actions that change no world: asking, pausing, showing). `None` means "not said".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le

from sim.planner_names import PlannerName
from sim.sensor_names import SensorName
from sim.types import Mode, Move

PlaceableKind = Literal["pothole", "vehicle", "barrier", "pedestrian", "av"]
Weather = Literal["clear", "rain", "fog", "snow"]
TimeOfDay = Literal["day", "dusk", "night", "dawn"]
RoadType = Literal["highway", "city", "rural"]
Layout = Literal["walls", "narrows", "dead_ends", "crossing", "maze"]
"""A family of roads (`sim.world.layouts`)."""
Traffic = Literal["none", "light", "normal", "heavy"]
Preference = Literal["avoid_potholes", "smooth_ride", "fastest", "cautious"]
"""What a vehicle can be asked to mind; `balanced` is none of them."""
Wish = Literal[Preference, "balanced"]
"""A preference as it is said."""

GoalName = Literal["harder", "easier", "surprise", "hard_but_solvable", "separates", "one_lane_free"]
"""What can be looked for (`sim.goals`): actions that stand for those that were found."""
Degree = Literal["little", "lot"]
"""How much harder or easier; not said: in between."""

Parameter = Literal[
    "weather",
    "time_of_day",
    "traffic",
    "planner",
    "sensor",
    "dynamics",
    "playback_speed",
    "target_speed_kmh",
    "step_seconds",
    "spawn_probability",
    "pothole_probability",
    "courtesy",
    "attentive",
    "sensor_noise",
    "detection_sensitivity",
    "false_positive_rate",
    "sensor_range_m",
    "safety_buffer",
    "columns",
    "rows",
    "seed",
]

MAX_THINGS = 10_000
"""The largest number of things one action may name; what the road can hold is checked later."""

Amount = Annotated[int, Ge(0), Le(MAX_THINGS)]
Some = Annotated[int, Ge(1), Le(MAX_THINGS)]

_STRICT = {"extra": "forbid"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Where:
    """A place, by any of its parts; parts combine ("15 m ahead in the left lane")."""

    lane: Literal["left", "middle", "right"] | Annotated[int, Ge(1)] | None = None
    row: Annotated[int, Ge(0)] | None = None
    cell: tuple[int, int] | None = None
    side: Literal["ahead", "behind", "left", "right"] | None = None
    distance_m: Annotated[float, Gt(0)] | None = None
    cells: Annotated[int, Ge(1)] | None = None
    nearest: Literal[True] | None = None
    id: str | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Add:
    """Put `count` things of a kind on the road."""

    do: Literal["add"] = "add"
    kind: PlaceableKind
    count: Some
    where: Where | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Remove:
    """Take `count` things of a kind (or `"all"`) off the road."""

    do: Literal["remove"] = "remove"
    kind: PlaceableKind | Literal["everything"]
    count: Some | Literal["all"]
    where: Where | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class SetCount:
    """Add or remove until there are exactly `count` things of a kind."""

    do: Literal["set_count"] = "set_count"
    kind: PlaceableKind
    count: Amount

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fresh world; what is not named is at its default."""

    do: Literal["scenario"] = "scenario"
    weather: Weather | None = None
    time_of_day: TimeOfDay | None = None
    road: RoadType | None = None
    layout: Layout | None = None
    traffic: Traffic | None = None
    potholes: Amount | None = None
    vehicles: Amount | None = None
    barriers: Amount | None = None
    pedestrians: Amount | None = None
    avs: Amount | None = None
    planner: PlannerName | None = None
    sensor: SensorName | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Reset:
    """The present episode from its start, on the road it started with."""

    do: Literal["reset"] = "reset"

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class SetMode:
    """Who drives: a person or the planner."""

    do: Literal["mode"] = "mode"
    mode: Mode
    ego: str | None = None
    """the id of the ego that is meant; None: the first"""

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """One move by a person, taken at the next tick that has none yet."""

    do: Literal["drive"] = "drive"
    move: Move
    ego: str | None = None
    """the id of the ego that is meant; None: the first"""

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Set:
    """Give a parameter a value."""

    do: Literal["set"] = "set"
    parameter: Parameter
    value: int | float | str

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Adjust:
    """Change a parameter by a factor, by a signed amount, or simply up or down."""

    do: Literal["adjust"] = "adjust"
    parameter: Parameter
    factor: Annotated[float, Gt(0)] | None = None
    by: float | None = None
    direction: Literal["up", "down"] | None = None

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        if [self.factor, self.by, self.direction].count(None) != 2:
            raise ValueError("say exactly one of 'factor', 'by' and 'direction'")


@dataclass(frozen=True, slots=True, kw_only=True)
class Prefer:
    """How the ego should weigh one way of driving against another."""

    do: Literal["prefer"] = "prefer"
    preference: Wish

    __pydantic_config__ = _STRICT


WorldAction = Add | Remove | SetCount | Scenario | Reset | SetMode | Drive | Set | Adjust | Prefer
