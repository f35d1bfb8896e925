"""What a session runs with: the table of `world.md`, checked as a whole.

A `Config` that exists is valid: the constructor raises `ConfigError` with *every* bad field.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any, Final, Literal, get_args

from sim import planner_names, sensor_names
from sim.actions import MAX_THINGS, Layout, Preference, RoadType, TimeOfDay, Traffic, Weather
from sim.codes import PROBLEMS, check_facts, plain_text
from sim.daily_traffic import vehicle_probability
from sim.randomness import MAX_SEED
from sim.rules.behaviour import DEFAULT_BEHAVIOUR, Behaviour
from sim.rules.behaviour_registry import BEHAVIOURS
from sim.rules.dynamics import DEFAULT_DYNAMICS, Dynamics
from sim.rules.dynamics_registry import DYNAMICS, dynamics_on
from sim.rules.limits import max_ticks
from sim.rules.versions import RULES
from sim.types import HAZARDS, KINDS, MOVERS, PLACEABLE, Kind
from sim.world.grid import Road
from sim.world.layouts import has_barriers, min_free_cells


class Problem:
    """One thing wrong with one field: a code of `sim.codes.PROBLEMS` and its facts."""

    __slots__ = ("code", "facts", "field")

    def __init__(self, field: str, code: str, **facts: Any) -> None:
        check_facts(code, facts, PROBLEMS.get(code))
        self.field = field
        self.code = code
        self.facts: Mapping[str, Any] = MappingProxyType(facts)

    @property
    def available(self) -> bool:
        """False where the value is one that this version knows by name only."""
        return "not_available" not in self.code

    def __str__(self) -> str:
        return plain_text(self.code, self.facts)

    def __repr__(self) -> str:
        return f"Problem({self.field}: {self})"


class ConfigError(ValueError):
    """A configuration that cannot be; `problems` names each bad field."""

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__("; ".join(f"{problem.field}: {problem}" for problem in problems))
        self.problems = problems


RANGES: Final[dict[str, tuple[float, float]]] = {
    "columns": (3, 64),
    "visible_rows": (4, 64),
    "rows": (4, 512),
    "cell_m": (0.5, 100.0),
    "step_seconds": (0.02, 10.0),
    "spawn_probability": (0.0, 1.0),
    "pothole_probability": (0.0, 1.0),
    **{KINDS[kind].plural: (0, MAX_THINGS) for kind in PLACEABLE},
    "courtesy": (0.0, 1.0),
    "attentive": (0.0, 1.0),
    "reset_delay_s": (0.0, 60.0),
    "safety_buffer": (0, 3),
    "detection_sensitivity": (0.05, 0.95),
    "sensor_range_m": (5.0, 150.0),
    "sensor_noise": (0.0, 0.5),
    "false_positive_rate": (0.0, 0.5),
    "sensor_latency": (0, 1),
    "slip_probability": (0.0, 1.0),
    "traffic_by_hour": (0.0, 1.0),
    "rules": (1, RULES),
    "seed": (0, MAX_SEED),
}
"""Inclusive limits of every number."""

Collision = Literal["swept", "cell"]
"""How a collision within a tick is judged."""

CHOICES: Final[dict[str, tuple[str, ...]]] = {
    "collision": get_args(Collision),
    "road": get_args(RoadType),
    "layout": get_args(Layout),
    "traffic": get_args(Traffic),
    "weather": get_args(Weather),
    "time_of_day": get_args(TimeOfDay),
    "dynamics": tuple(DYNAMICS),
    "behaviour": tuple(BEHAVIOURS),
}
"""The words that may stand where a word is asked for."""

PROMISED: Final[dict[str, tuple[str, ...]]] = {
    "planner": planner_names.PROMISED,
    "dynamics": ("continuous",),
}
"""Values that people may ask for and this version has not."""

LISTS: Final[dict[str, tuple[str, ...]]] = {"preferences": get_args(Preference)}
"""The words that may stand in a list."""

_WHOLE: Final = frozenset(
    (
        "columns",
        "visible_rows",
        "rows",
        *(KINDS[kind].plural for kind in PLACEABLE),
        "safety_buffer",
        "sensor_latency",
        "rules",
        "seed",
    )
)
_SWITCHES: Final = frozenset(("solvable", "repetition"))
_OPTIONAL: Final = frozenset(("potholes", "vehicles", "road", "layout", "traffic"))


class Derived:
    """What follows from the fields of a configuration. Worked out once, since every tick asks for it."""

    __slots__ = (
        "_dynamics",
        "certain",
        "free_ways_hold",
        "max_ticks",
        "mover_behaviour",
        "reacting",
        "slips",
        "vehicle_probability",
    )

    mover_behaviour: Behaviour
    """how obstacle vehicles and pedestrians move"""
    certain: bool
    """whether the future is certain: nothing is left to chance once the road is drawn"""
    reacting: bool
    """whether movers react to the ego, so that where they go depends on where it is"""
    free_ways_hold: bool
    """whether a way that meets nothing in a forecast without reactions meets nothing when driven"""
    slips: float
    """chance that a step to the side slips (`sim.rules.slipping`); 0 but on snow"""
    vehicle_probability: float
    """chance of an obstacle vehicle in a row at this time of day (`sim.daily_traffic`)"""
    max_ticks: int
    """an episode that lasts longer is STUCK"""
    _dynamics: Dynamics


@dataclass(frozen=True, slots=True, kw_only=True)
class Config(Derived):
    """Everything a world is made from besides the seed's own draws.

    `potholes` and `vehicles` are exact numbers that replace their probabilities when given;
    `road` and `traffic` remember which preset the numbers came from (`sim.session.scenario`).
    """

    columns: int = 8
    visible_rows: int = 8
    rows: int = 30
    cell_m: float = 5.0
    step_seconds: float = 0.5
    spawn_probability: float = 0.68
    pothole_probability: float = 0.15
    potholes: int | None = None
    vehicles: int | None = None
    barriers: int = 0
    pedestrians: int = 0
    courtesy: float = 0.0
    """chance that a mover beside the ego counts its cell as blocked and turns round"""
    attentive: float = 1.0
    """chance that a mover brakes for a vehicle that stands still before it"""
    collision: Collision = "swept"
    """`swept`: bodies of stated size that move linearly within a tick (`sim.rules.collision_geometry`);
    `cell`: cells alone"""
    repetition: bool = True
    """whether a vehicle whose situation repeats is STUCK at once, and not at the limit of ticks"""
    reset_delay_s: float = 2.0
    road: RoadType | None = None
    layout: Layout | None = None
    """the family of roads (`sim.world.layouts`), drawn until one can be driven; None: things are scattered"""
    traffic: Traffic | None = None
    planner: str = "rules"
    """an older name is taken for the present one (`sim.planner_names.ALIASES`)"""
    preferences: tuple[Preference, ...] = ()
    """how planners that weigh costs should weigh them; the balance is in `sim.search.costs`"""
    safety_buffer: int = 1
    """cells around a mover that cost something to be in, for planners that weigh costs"""
    sensor: str = sensor_names.DEFAULT_SENSOR
    """what the ego sees with (`sim.perceive`)"""
    weather: Weather = "clear"
    """what sensors see through (`sim.perceive.parameters`), and the friction of `sim.hazard_advice`"""
    time_of_day: TimeOfDay = "day"
    """how much light a camera has"""
    detection_sensitivity: float = 0.5
    """things are heeded that are believed to be there with a likelihood of at least 1 − sensitivity"""
    sensor_range_m: float = 150.0
    """no device sees farther than this (m), nor than its own range"""
    sensor_noise: float = 0.0
    """standard deviation added to measured distances, as a share of the distance"""
    false_positive_rate: float = 0.0
    """chance, added to its own, that a device reports something in a look that is not there"""
    sensor_latency: int = 0
    """ticks after which what sensors that err have looked at is known"""
    slip_probability: float = 0.0
    """chance that a step to the side is lost on snow (`sim.rules.slipping`)"""
    traffic_by_hour: float = 0.0
    """how much of the difference in traffic between times of day counts (`sim.daily_traffic`), 0 to 1"""
    dynamics: str = DEFAULT_DYNAMICS
    """how autonomous vehicles move (`sim.rules.dynamics`)"""
    behaviour: str = DEFAULT_BEHAVIOUR
    """how the other road users move, and whether they react (`sim.rules.behaviour_registry`)"""
    rules: int = RULES
    """version of the rules that defaults come from (`sim.rules.versions`)"""
    solvable: bool = False
    """draw roads until one can be driven"""
    seed: int = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "planner", planner_names.canonical(self.planner))
        problems = tuple(self._problems())
        if problems:
            raise ConfigError(problems)
        self._derive()

    def _derive(self) -> None:
        behaviour = BEHAVIOURS[self.behaviour]
        slips = self.slip_probability if self.weather == "snow" else 0.0
        known = {
            "mover_behaviour": behaviour,
            "certain": behaviour.certain(self) and not slips,
            "reacting": behaviour.reads_egos(self),
            "free_ways_hold": behaviour.free_ways_hold(self) and not slips,
            "slips": slips,
            "vehicle_probability": vehicle_probability(
                self.spawn_probability, self.time_of_day, self.traffic_by_hour
            ),
            "max_ticks": max_ticks(self.rows),
            "_dynamics": dynamics_on(self.geometry, self.dynamics, self.collision == "swept"),
        }
        for name, value in known.items():
            object.__setattr__(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        # Not `__setstate__`: frozen dataclasses with slots replace it before Python 3.11.4.
        return _restored, tuple(getattr(self, field.name) for field in fields(self))

    def with_parts(self, **parts: Any) -> Config:
        """This configuration with some fields changed. Raises `ConfigError`."""
        for name in LISTS:
            if isinstance(parts.get(name), list):
                parts[name] = tuple(parts[name])
        unknown = sorted(set(parts) - {field.name for field in fields(self)})
        if unknown:
            raise ConfigError(tuple(_unknown(name) for name in unknown))
        return replace(self, **parts)

    def ego_dynamics(self, road: Road) -> Dynamics:
        """How autonomous vehicles move on a road."""
        motion = self._dynamics
        if motion.road is road:
            return motion
        return dynamics_on(road, self.dynamics, self.collision == "swept")

    @property
    def reset_delay_ticks(self) -> int:
        """Ticks for which a result stands before the next episode; at least one."""
        return max(1, -int(-self.reset_delay_s // self.step_seconds))

    @property
    def geometry(self) -> Road:
        """The empty road."""
        return Road.of(self.columns, self.rows)

    def _problems(self) -> list[Problem]:
        problems = [*self._number_problems(), *self._word_problems()]
        if not problems:
            problems += self._room_problems()
        return problems

    def _number_problems(self) -> list[Problem]:
        problems = []
        for name in _NUMBERS:
            low, high = RANGES[name]
            value = getattr(self, name)
            if value is None and name in _OPTIONAL:
                continue
            allowed = int if name in _WHOLE else (int, float)
            if isinstance(value, bool) or not isinstance(value, allowed):
                problems.append(
                    Problem(name, "must_be_a_whole_number" if name in _WHOLE else "must_be_a_number")
                )
            elif not low <= value <= high:
                problems.append(Problem(name, "must_be_between", low=low, high=high))
        return problems

    def _word_problems(self) -> list[Problem]:
        problems = [
            _not_one_of(name, getattr(self, name), choices)
            for name, choices in CHOICES.items()
            if getattr(self, name) not in choices and not (name in _OPTIONAL and getattr(self, name) is None)
        ]
        if self.sensor not in sensor_names.names():
            problems.append(_not_one_of("sensor", self.sensor, sensor_names.names()))
        planner = self.planner
        if not isinstance(planner, str) or planner in PROMISED["planner"] or not planner_names.known(planner):
            problems.append(_not_one_of("planner", planner, planner_names.names()))
        for name, choices in LISTS.items():
            words = getattr(self, name)
            fit = isinstance(words, tuple) and all(word in choices for word in words)
            if not fit or len(set(words)) < len(words):
                problems.append(Problem(name, "must_be_a_list_of", choices=choices))
        problems += [
            Problem(name, "must_be_true_or_false")
            for name in _SWITCHES
            if not isinstance(getattr(self, name), bool)
        ]
        return problems

    def _room_problems(self) -> list[Problem]:
        if has_barriers(self.layout) and self.barriers:
            return [Problem("barriers", "must_not_be_counted", layout=self.layout)]
        room = min_free_cells(self.layout, self.columns, self.rows)
        counts = {
            COUNTS[kind]: getattr(self, COUNTS[kind]) or 0
            for kind in (*MOVERS, *reversed(HAZARDS))
            if kind in COUNTS
        }
        # Drawn things take at most one cell of a row each; with a layout they take what is left.
        drawn = (self.rows - 2) * sum(getattr(self, name) is None for name in COUNTS.values())
        if self.layout is not None:
            drawn = 0
        if sum(counts.values()) + drawn <= room:
            return []
        largest = max(counts, key=lambda name: counts[name])
        left = max(0, room - drawn - sum(counts.values()) + counts[largest])
        return [Problem(largest, "too_many", room=left)]


_NUMBERS: Final = tuple(field.name for field in fields(Config) if field.name in RANGES)

COUNTS: Final[Mapping[Kind, str]] = {
    kind: KINDS[kind].plural for kind in PLACEABLE if KINDS[kind].plural in _NUMBERS
}
"""The field of the exact number of each kind; a kind without one is only put on a road by hand."""


def _restored(*values: Any) -> Config:
    """A configuration from the values of its fields, which are known to fit."""
    config: Config = object.__new__(Config)
    for field, value in zip(fields(Config), values, strict=True):
        object.__setattr__(config, field.name, value)
    config._derive()
    return config


def _unknown(name: str) -> Problem:
    """That a setting does not exist, and which may have been meant."""
    near = get_close_matches(str(name).lower(), [field.name for field in fields(Config)], n=1)
    if near:
        return Problem(name, "not_a_setting_but_near", near=near[0])
    return Problem(name, "not_a_setting")


def _not_one_of(name: str, value: object, choices: tuple[str, ...]) -> Problem:
    promised = value in PROMISED.get(name, ())
    if len(choices) > 1:
        if promised:
            return Problem(name, "not_available_one_of", choices=choices, value=value)
        return Problem(name, "must_be_one_of", choices=choices)
    if promised:
        return Problem(name, "not_available_must_be", choice=choices[0], value=value)
    return Problem(name, "must_be", choice=choices[0])
