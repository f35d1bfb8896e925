"""Answers to "what is the spawn probability?", "are you using A*?" and "which planners are there?"."""

from __future__ import annotations

from math import isclose
from typing import Any, Final, cast, get_args

from service.actions import Choosable, ViewName
from service.actions.table import PLAYBACK_SPEED
from service.narration.answerer import Json, plain
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.narration.values import speed
from service.sessions.facts import Asked
from service.sessions.scheduler.playback_speed import FASTEST, SLOWEST, PlaybackSpeed
from sim import planner_names, sensor_names
from sim.actions import Layout, Parameter, RoadType, Set, TimeOfDay, Traffic, Weather, Wish
from sim.config import RANGES, Config
from sim.planner_names import canonical
from sim.session.scenario import TRAFFIC
from sim.session.settings import AS_IT_IS, is_available
from sim.types import Mode

KMH: Final = 3.6
"""Kilometres an hour of a metre a second."""
WORDS: Final[dict[str, tuple[str, ...]]] = {
    "weather": get_args(Weather),
    "time_of_day": get_args(TimeOfDay),
    "traffic": get_args(Traffic),
    "dynamics": ("grid", "continuous"),
    "preference": get_args(Wish),
    "road": get_args(RoadType),
    "layout": get_args(Layout),
    "view": tuple(view for view in get_args(ViewName) if view != "sensors"),
}
"""The values of what takes words, without those that are named at run time."""
_EXACT: Final = {"spawn_probability": "vehicles", "pothole_probability": "potholes"}
"""The exact numbers that take the place of probabilities."""


class Settings:
    """Answers about one setting, and about what can be chosen."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, run = asked.ask, asked.timeline.state
        if ask.about == "options":
            told, values = self._options(ask.parameter, run.config, asked.playback_speed)
            return plain(self._sayings, ask, run, told) | {"parameter": ask.parameter, "options": values}
        name = str(ask.parameter)
        value = setting_now(name, run.config, asked.playback_speed)
        told = self._told(name, value, run.config)
        holds = None if ask.value is None else _same(name, value, ask.value, run.config)
        if holds is not None:
            told = self._say("yes" if holds else "no", told=told)
        if name == "planner" and run.mode is Mode.MANUAL:
            told = f"{told} {self._say('manual')}"
        return plain(self._sayings, ask, run, told) | {"parameter": name, "value": value, "holds": holds}

    def _told(self, name: str, value: Any, config: Config) -> str:
        """A setting and its value, as a sentence."""
        if name in self._sayings.words("settings", "no_setting"):
            seconds, metres = config.step_seconds, config.cell_m
            return self._say(
                "no_setting",
                name,
                metres=self._number(metres),
                seconds=self._number(seconds),
                kmh=self._number(round(metres / seconds * KMH, 1)),
            )
        if name == "traffic" and value is None:
            return self._say("without_level", value=self._number(config.spawn_probability))
        keys: tuple[str, ...] = ("is", name)
        if isinstance(self._sayings.words("settings", *keys), dict):
            keys = (*keys, "one" if value == 1 else "many")
        length = self._number(config.rows * config.cell_m)
        told = self._say(*keys, value=self._value(name, value), metres=length)
        if name in AS_IT_IS and len(_available(name)) == 1:
            return self._say("always", told=told)
        if getattr(config, _EXACT.get(name, ""), None) is not None:
            return f"{told} {self._say('exact_number')}"
        return told

    def _options(
        self, name: str | None, config: Config, pace: PlaybackSpeed
    ) -> tuple[str, list[str] | list[float]]:
        """What can be chosen for a thing, or which things can be chosen for; and the same as values."""
        if name is None:
            found = [each for each in (*get_args(Parameter), *get_args(Choosable)) if _changeable(each)]
            names = self._sayings.joined([self._say("names", each) for each in found])
            return self._say("choose", names=names, example=self._say("choose_example")), found
        called = capital(self._say("names", name))
        values = _available(name)
        if values:
            told = [str(self._value(name, value)) for value in values]
            if len(values) == 1:
                return self._say("only", name=called, value=told[0]), values
            listed = self._sayings.joined(told)
            return self._say("one_of", name=called, values=listed, example=self._example(name)), values
        if not _changeable(name):
            return self._say("nothing", name=called), []
        low, high = (SLOWEST, FASTEST) if name == PLAYBACK_SPEED else RANGES[name]
        now = self._value(name, setting_now(name, config, pace))
        bounds = {"low": self._number(low), "high": self._number(high)}
        if name == PLAYBACK_SPEED:
            bounds = {"low": speed(self._sayings, low), "high": speed(self._sayings, high)}
        key = "pace" if name == PLAYBACK_SPEED else "between"
        return self._say(key, name=called, value=now, example=self._example(name), **bounds), [low, high]

    def _value(self, name: str, value: Any) -> str:
        """A value as it is called."""
        if name == PLAYBACK_SPEED:
            return speed(self._sayings, value)
        if not isinstance(value, str):
            return self._number(value)
        words = self._sayings.words("settings", "values")[name]
        return self._say("values", name, value if value in words else "other", value=value)

    def _number(self, value: float) -> str:
        return self._sayings.number(value, "" if isinstance(value, int) else ".10g")

    def _example(self, name: str) -> str:
        return self._say("examples", name)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("settings", *keys, **parts)


def setting_now(name: str, config: Config, pace: PlaybackSpeed) -> Any:
    """The value that a setting has; None where there is no such setting, or it has no value of its own."""
    if name == PLAYBACK_SPEED:
        return pace
    value = getattr(config, name, AS_IT_IS.get(name))
    if name == "traffic" and value is None:
        return next((level for level, rate in TRAFFIC.items() if rate == config.spawn_probability), None)
    return value


def _same(name: str, value: Any, asked: int | float | str, config: Config) -> bool:
    """Whether a setting has the value that was asked about."""
    if name == "target_speed_kmh":
        value = config.cell_m / config.step_seconds * KMH
    if isinstance(value, str) or isinstance(asked, str):
        return bool(canonical(asked) == value if name == "planner" else asked == value)
    return value is not None and isclose(value, asked, rel_tol=1e-6)


def _available(name: str) -> list[str]:
    """The words that can be chosen for something; empty where it takes numbers."""
    if name == "planner":
        return list(planner_names.names())
    if name == "sensor":
        return list(sensor_names.names())
    words = WORDS.get(name, ())
    if name in get_args(Choosable):
        return list(words)
    return [word for word in words if is_available(Set(parameter=cast(Parameter, name), value=word))]


def _changeable(name: str) -> bool:
    """Whether there is more than one value to choose."""
    words = _available(name)
    return len(words) > 1 if words else name == PLAYBACK_SPEED or name in RANGES
