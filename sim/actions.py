"""What may be done to a world: the actions that a session's log is made of.

Plain dataclasses, one per `do` of the language contract, so that the rules need no validation
library; the service checks incoming JSON against these same classes (`service.actions` adds
the actions that change no world: asking, pausing, showing). `None` means "not said".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le, Len

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
    "sensor_latency",
    "slip_probability",
    "traffic_by_hour",
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

Lane = Annotated[int, Ge(1)]
"""A lane by its number, 1 = leftmost."""
Row = Annotated[int, Ge(0)]
"""A row by its number, 0 = destination."""
Direction = Literal["ahead", "behind", "left", "right"]

_STRICT = {"extra": "forbid"}


def _json_name(name: str) -> str:
    """The key of a field in JSON: words that Python keeps for itself have an underscore after them here."""
    return name.removesuffix("_")


_STRICT_NAMES = {"extra": "forbid", "alias_generator": _json_name}


@dataclass(frozen=True, slots=True, kw_only=True)
class Landmark:
    """The thing that a place is described from: the nearest of a kind, or one by its id."""

    kind: PlaceableKind | None = None
    nearest: Literal[True] | None = None
    id: str | None = None

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        if (self.id is None) is (self.kind is None) or (self.id is None) is not (self.nearest is True):
            raise ValueError("say either 'id', or 'kind' with 'nearest': true")


@dataclass(frozen=True, slots=True, kw_only=True)
class Where:
    """A place, by any of its parts; parts combine ("15 m ahead in the left lane")."""

    lane: Literal["left", "middle", "right"] | Lane | None = None
    lanes: tuple[Lane, Lane] | None = None
    """from one lane to another, both included"""
    row: Row | None = None
    rows: tuple[Row, Row] | None = None
    """from one row to another, both included"""
    cell: tuple[int, int] | None = None
    side: Direction | Literal["beside"] | None = None
    """seen from the first ego, or from `of`; beside: to its left or right"""
    distance_m: Annotated[float, Gt(0)] | None = None
    cells: Annotated[int, Ge(1)] | None = None
    nearest: Literal[True] | None = None
    id: str | None = None
    each: Literal["lane"] | None = None
    """a count holds for each lane: of those that are named, or of all"""
    of: Landmark | None = None
    """what side, distance and nearest are seen from, instead of the first ego"""

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Shift:
    """So many cells to one side."""

    side: Direction
    cells: Annotated[int, Ge(1)] = 1

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class OneThing:
    """One thing of a kind: the nearest one at a place."""

    kind: PlaceableKind
    where: Where | None = None

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
    """Take `count` things of a kind (or `"all"`, or `"half"` of them) off the road."""

    do: Literal["remove"] = "remove"
    kind: PlaceableKind | Literal["everything"]
    count: Some | Literal["all", "half"]
    where: Where | None = None
    except_: Where | None = None
    """things there stay; `except` in JSON"""

    __pydantic_config__ = _STRICT_NAMES


@dataclass(frozen=True, slots=True, kw_only=True)
class SetCount:
    """Add or remove until there are exactly `count` things of a kind."""

    do: Literal["set_count"] = "set_count"
    kind: PlaceableKind
    count: Amount

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveThings:
    """Put things that are on the road somewhere else on it; they stay what they are."""

    do: Literal["move"] = "move"
    kind: PlaceableKind
    count: Some | Literal["all"]
    where: Where | None = None
    to: Where | None = None
    """where they are to be"""
    by: Shift | None = None
    """how far from where they are"""

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        if (self.to is None) is (self.by is None):
            raise ValueError("say exactly one of 'to' and 'by'")


@dataclass(frozen=True, slots=True, kw_only=True)
class Swap:
    """Let two things change places."""

    do: Literal["swap"] = "swap"
    first: OneThing
    second: OneThing

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Replace:
    """Put things of another kind (`by`) in the places of things."""

    do: Literal["replace"] = "replace"
    kind: PlaceableKind
    count: Some | Literal["all"]
    where: Where | None = None
    by: PlaceableKind

    __pydantic_config__ = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Copy:
    """Put another thing like it on the road, for each of some things: beside it, or where it is said."""

    do: Literal["copy"] = "copy"
    kind: PlaceableKind
    count: Some | Literal["all"]
    where: Where | None = None
    to: Where | None = None

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Pause:
    """Stop the clock."""

    do: Literal["pause"] = "pause"

    __pydantic_config__ = _STRICT


Fact = Literal[
    "crash",
    "arrival",
    "stuck",
    "episode",
    "move",
    "every",
    "after",
    "tick",
    "row",
    "lane",
    "standing",
    "goal",
    "near",
    "count",
    "weather",
    "time_of_day",
]
"""What a condition is about. Events (they happen in a tick): `crash`, `arrival`, `stuck`, `episode`, a road
that begins, and `move`, a step to the side. Times: `every`, `after` (since the rule was made) and `tick` (of
the session). The rest are so or not so: `row`, `lane`, `standing` (it stayed where it was), `goal` (how far
the goal is), `near` (how far the nearest thing is), `count` (how many things there are), `weather`,
`time_of_day`."""

_KEYS: dict[str, tuple[frozenset[str], ...]] = {
    **dict.fromkeys(("crash", "arrival", "stuck", "episode", "standing"), (frozenset(),)),
    "move": (frozenset(("move",)),),
    **dict.fromkeys(("every", "after"), (frozenset(("ticks",)), frozenset(("seconds",)))),
    "tick": (frozenset(("tick",)),),
    "row": (frozenset(("row",)),),
    **{
        fact: (frozenset((fact,)), frozenset((fact, "no_longer")))
        for fact in ("lane", "weather", "time_of_day")
    },
    "goal": (frozenset(("closer_than_m",)), frozenset(("within_m",))),
    "near": tuple(
        frozenset((bound, *keys))
        for bound in ("closer_than_m", "within_m", "farther_than_m")
        for keys in ((), ("kind",), ("side",), ("kind", "side"))
    ),
    "count": (
        frozenset(("kind", "at_least")),
        frozenset(("kind", "at_most")),
        frozenset(("kind", "at_least", "at_most")),
    ),
}
"""What a condition about each fact names, in each of the ways it can be said."""
_CONDITION_KEYS = sorted({key for ways in _KEYS.values() for way in ways for key in way})


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """What a rule waits for: one fact, with its figures."""

    fact: Fact
    ticks: Annotated[int, Ge(1), Le(100_000)] | None = None
    seconds: Annotated[float, Gt(0), Le(100_000)] | None = None
    tick: Annotated[int, Ge(0)] | None = None
    """a tick of the session"""
    row: Row | None = None
    """reached: the first ego is there or nearer to the goal"""
    lane: Literal["left", "middle", "right"] | Lane | None = None
    move: Literal["left", "right", "lane_change"] | None = None
    """the first ego came into a lane further left, further right, or either"""
    kind: PlaceableKind | None = None
    closer_than_m: Annotated[float, Gt(0)] | None = None
    within_m: Annotated[float, Gt(0)] | None = None
    farther_than_m: Annotated[float, Gt(0)] | None = None
    side: Literal["ahead", "behind"] | None = None
    """only what stands straight before or behind the first ego counts as near"""
    at_least: Amount | None = None
    at_most: Amount | None = None
    weather: Weather | None = None
    time_of_day: TimeOfDay | None = None
    no_longer: Literal[True] | None = None
    """it holds where the fact is not so"""

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        named = frozenset(key for key in _CONDITION_KEYS if getattr(self, key) is not None)
        ways = _KEYS.get(self.fact, ())
        if named not in ways:
            told = " or ".join(" and ".join(sorted(each)) or "nothing more" for each in ways)
            raise ValueError(f"a condition about {self.fact} names {told}")
        if self.at_least is not None and self.at_most is not None and self.at_least > self.at_most:
            raise ValueError("'at_least' is more than 'at_most'")


RuleAction = (
    Add
    | Remove
    | SetCount
    | MoveThings
    | Swap
    | Replace
    | Copy
    | Scenario
    | Reset
    | SetMode
    | Drive
    | Set
    | Adjust
    | Prefer
    | Pause
)
"""What a rule may do: change the world, or stop the clock."""

MAX_RULE_ACTIONS = 10
"""How many actions one rule may hold."""
MAX_FIRINGS = 1_000
"""How often one rule fires at most; then it is switched off."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trigger:
    """A rule: whenever the condition comes to hold, these actions are done at the end of that tick.

    The condition of a storyboard event in ASAM OpenSCENARIO, on its rising edge.
    """

    do: Literal["trigger"] = "trigger"
    when: Condition
    then: Annotated[tuple[RuleAction, ...], Len(1, MAX_RULE_ACTIONS)]
    until: Condition | None = None
    """when the rule ends"""
    times: Annotated[int, Ge(1), Le(MAX_FIRINGS)] | None = None
    """how often it fires before it ends"""

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        if self.until is not None and self.until.fact == "every":
            raise ValueError("a rule cannot end every so often")
        if any(getattr(action, "parameter", None) == "playback_speed" for action in self.then):
            raise ValueError("a rule changes no playback speed")


@dataclass(frozen=True, slots=True, kw_only=True)
class Cancel:
    """Switch rules off: one by its number or place, all, the last, or those that do such an action."""

    do: Literal["cancel"] = "cancel"
    which: Annotated[int, Ge(1)] | Literal["all", "last"] | None = None
    place: Annotated[int, Ge(1)] | None = None
    """which of the list: 1 for the first that stands"""
    doing: str | None = None
    """the `do` of an action that the rules have"""
    kind: PlaceableKind | None = None
    """the kind of that action's things"""

    __pydantic_config__ = _STRICT

    def __post_init__(self) -> None:
        if [self.which, self.place, self.doing].count(None) != 2:
            raise ValueError("say exactly one of 'which', 'place' and 'doing'")
        if self.kind is not None and self.doing is None:
            raise ValueError("'kind' belongs to 'doing'")


Rearranging = MoveThings | Swap | Replace | Copy
"""Actions on things that are on the road already."""

WorldAction = (
    Add
    | Remove
    | SetCount
    | MoveThings
    | Swap
    | Replace
    | Copy
    | Scenario
    | Reset
    | SetMode
    | Drive
    | Set
    | Adjust
    | Prefer
    | Trigger
    | Cancel
)
