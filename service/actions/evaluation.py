"""Actions that run many episodes, and advice about a hazard; they hold no other action."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le

from service.actions.steering import STRICT, Name
from sim.actions import Amount, Layout, PlaceableKind, RoadType, TimeOfDay, Traffic, Weather
from sim.planner_names import PlannerName
from sim.sensor_names import SensorName


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenarioParts:
    """The keys of `scenario`, as conditions of an evaluation."""

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

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Varied:
    """Values that are compared: an evaluation runs under each combination of them, from the same seeds."""

    weather: tuple[Weather, ...] | None = None
    time_of_day: tuple[TimeOfDay, ...] | None = None
    sensor: tuple[SensorName, ...] | None = None
    traffic: tuple[Traffic, ...] | None = None
    potholes: tuple[Amount, ...] | None = None
    vehicles: tuple[Amount, ...] | None = None
    barriers: tuple[Amount, ...] | None = None
    pedestrians: tuple[Amount, ...] | None = None

    __pydantic_config__ = STRICT


MapAxis = Literal["potholes", "vehicles", "barriers", "pedestrians"]
"""What a success map may be drawn over: numbers of things."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluate:
    """Many episodes, compared."""

    do: Literal["evaluate"] = "evaluate"
    runs: Annotated[int, Ge(1), Le(1_000_000)] | None = None
    planners: tuple[PlannerName, ...] | None = None
    scenario: ScenarioParts | None = None
    road: Literal["this"] | None = None
    """the session's own road from this moment on, in place of roads that are drawn"""
    scenario_name: Name | None = None
    """a scenario that comes with Roadtalk, or a moment that was saved in the session, by its name"""
    vary: Varied | None = None
    """conditions that are compared, such as fog with clear weather"""
    map: tuple[MapAxis, MapAxis] | None = None
    """a success map over these numbers of things; `vary` has their values, where they are given"""

    __pydantic_config__ = STRICT


EvaluationWish = Literal["progress", "cancel", "better"]
"""What is wanted of an evaluation; `better`: which planner was."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationTalk:
    """How the session's latest evaluation stands, its end before it is done, or who was better in it."""

    do: Literal["evaluation"] = "evaluation"
    want: EvaluationWish
    planners: tuple[PlannerName, ...] | None = None
    """those of which one was better, where they are named"""

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        if self.planners is not None and (self.want != "better" or len(set(self.planners)) != 2):
            raise ValueError("'planners' are the two of which one was better")


@dataclass(frozen=True, slots=True, kw_only=True)
class FindWorst:
    """The world in which a planner fares worst."""

    do: Literal["find_worst"] = "find_worst"
    runs: Annotated[int, Ge(1), Le(1_000_000)] | None = None
    planner: PlannerName | None = None

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Advise:
    """What to do about a hazard at a distance, at a speed."""

    do: Literal["advise"] = "advise"
    hazard: PlaceableKind
    distance_m: Annotated[float, Gt(0)]
    speed_kmh: Annotated[float, Ge(0)]

    __pydantic_config__ = STRICT
