"""The language contract's actions, as the one type everything that is said must become.

Grammar, language model, voice and typed REST calls meet here and only here. The actions that
change a world are `sim.actions`; those below steer the session, its pictures and its questions.
Validation is pydantic's, over plain dataclasses; `None` means "not said" and is left out of JSON.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias

from annotated_types import Ge, Gt, Le, MaxLen, MinLen
from pydantic import ConfigDict, Discriminator, TypeAdapter
from pydantic_core import to_json

from sim.actions import (
    Add,
    Adjust,
    Amount,
    Drive,
    Layout,
    PlaceableKind,
    Prefer,
    Remove,
    Reset,
    RoadType,
    Scenario,
    Set,
    SetCount,
    SetMode,
    TimeOfDay,
    Traffic,
    Weather,
    Where,
)
from sim.planner_names import PlannerName
from sim.sensor_names import SensorName
from sim.types import Move

__all__ = ["ACTIONS", "Action", "Where", "dump", "load"]

_STRICT = {"extra": "forbid"}

Ticks = Annotated[int, Ge(1), Le(10_000)]
Name = Annotated[str, MinLen(1), MaxLen(80)]
Phrase = Annotated[str, MinLen(1), MaxLen(80)]
MAX_MEANT = 50
"""How many actions a what-if or a taught phrase may hold."""
ViewName = Literal["road", "schematic", "occupancy", "plan", "log", "potholes", "sensors", "path", "metrics"]
MetricName = Literal["crashes", "successes", "success_rate", "steps", "moves", "distance"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Pause:
    """Stop the clock."""

    do: Literal["pause"] = "pause"

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Resume:
    """Start the clock."""

    do: Literal["resume"] = "resume"

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Undo:
    """Take back the latest change, as if it had never been said."""

    do: Literal["undo"] = "undo"

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Redo:
    """Say again what was undone last."""

    do: Literal["redo"] = "redo"

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """Run some ticks at once, and stay paused after them."""

    do: Literal["step"] = "step"
    ticks: Ticks

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewind:
    """Go back some ticks."""

    do: Literal["rewind"] = "rewind"
    ticks: Ticks

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Show:
    """Show a view."""

    do: Literal["show"] = "show"
    view: ViewName

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Hide:
    """Hide a view."""

    do: Literal["hide"] = "hide"
    view: ViewName

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Ask:
    """A question; which keys belong to which `about` is the contract's table."""

    do: Literal["ask"] = "ask"
    about: Literal[
        "why",
        "why_not",
        "what_if",
        "next",
        "scene",
        "status",
        "metrics",
        "confidence",
        "maintenance",
        "help",
    ]
    move: Move | None = None
    tick: Annotated[int, Ge(0)] | None = None
    change: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)] | None = None
    kind: PlaceableKind | None = None
    metric: MetricName | None = None

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        may, must = _ASKED_WITH.get(self.about, ((), ()))
        for key in ("move", "tick", "change", "kind", "metric"):
            said = getattr(self, key) is not None
            if said and key not in may:
                raise ValueError(f"'{key}' does not belong to a question about {self.about}")
            if not said and key in must:
                raise ValueError(f"a question about {self.about} needs '{key}'")
        _no_such("it cannot be asked what if to", self.change or (), (Ask, Teach, Forget))


_ASKED_WITH: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "why": (("move", "tick"), ()),
    "why_not": (("move", "tick"), ("move",)),
    "what_if": (("change",), ("change",)),
    "scene": (("kind",), ()),
    "metrics": (("metric",), ()),
}
"""The keys that a question may name, and those it must."""


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

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluate:
    """Many episodes, compared."""

    do: Literal["evaluate"] = "evaluate"
    runs: Annotated[int, Ge(1), Le(1_000_000)] | None = None
    planners: tuple[PlannerName, ...] | None = None
    scenario: ScenarioParts | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class FindWorst:
    """The world in which a planner fares worst."""

    do: Literal["find_worst"] = "find_worst"
    runs: Annotated[int, Ge(1), Le(1_000_000)] | None = None
    planner: PlannerName | None = None

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Advise:
    """What to do about a hazard at a distance, at a speed."""

    do: Literal["advise"] = "advise"
    hazard: PlaceableKind
    distance_m: Annotated[float, Gt(0)]
    speed_kmh: Annotated[float, Ge(0)]

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Save:
    """Keep the session under a name."""

    do: Literal["save"] = "save"
    name: Name

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """Go on from what was saved under a name."""

    do: Literal["load"] = "load"
    name: Name

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """Start or stop recording."""

    do: Literal["record"] = "record"
    on: bool

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Teach:
    """From now on, a phrase means these actions."""

    do: Literal["teach"] = "teach"
    phrase: Phrase
    meaning: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)]

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        _no_such("a phrase cannot mean to", self.meaning, (Teach, Forget))


@dataclass(frozen=True, slots=True, kw_only=True)
class Forget:
    """A taught phrase means nothing any more."""

    do: Literal["forget"] = "forget"
    phrase: Phrase

    __pydantic_config__ = _STRICT


def _no_such(why: str, actions: Iterable[Action], kinds: tuple[type, ...]) -> None:
    """Raise where an action is of a kind that must not stand inside another."""
    for action in actions:
        if isinstance(action, kinds):
            raise ValueError(f"{why} {action.do}")


Action: TypeAlias = Annotated[
    Add
    | Remove
    | SetCount
    | Scenario
    | Reset
    | SetMode
    | Drive
    | Set
    | Adjust
    | Prefer
    | Pause
    | Resume
    | Undo
    | Redo
    | Step
    | Rewind
    | Show
    | Hide
    | Ask
    | Evaluate
    | FindWorst
    | Advise
    | Save
    | Load
    | Record
    | Teach
    | Forget,
    Discriminator("do"),
]

# Built when first used: it takes a quarter of what importing this does.
ACTIONS: TypeAdapter[tuple[Action, ...]] = TypeAdapter(
    tuple[Action, ...], config=ConfigDict(defer_build=True)
)


def load(values: Any) -> tuple[Action, ...]:
    """Actions from JSON values. Raises `pydantic.ValidationError`, naming each bad field.

    Strictly: `"5"` and `true` are no numbers. (Strictness over Python values would ask for
    dataclasses where JSON has objects, hence the way through JSON.)
    """
    return ACTIONS.validate_json(to_json(values), strict=True)


def dump(actions: tuple[Action, ...]) -> list[dict[str, Any]]:
    """Actions as JSON values, in the contract's form: what was not said is absent."""
    values: list[dict[str, Any]] = ACTIONS.dump_python(actions, mode="json", exclude_none=True)
    return values
