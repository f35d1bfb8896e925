"""Conditions of an evaluation in words: "in fog, at night, with the camera, with 40 potholes"."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final

from service.narration.sayings import Sayings
from service.narration.values import value_of
from sim.config import COUNTS, Config
from sim.types import KINDS

_SAID: Final = ("road", "layout", "traffic", "weather", "time_of_day", "sensor")
"""Settings with words of their own, in the order in which they are said."""
_NUMBERS: Final = ("courtesy", "attentive", "safety_buffer", "detection_sensitivity", "step_seconds")
_DRAWN: Final = {"spawn_probability": "traffic", "pothole_probability": None}
"""Probabilities, and what tells them already."""


class Conditions:
    """Conditions in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def short(self, config: Config, without: Mapping[str, Any] | None = None) -> str:
        """What differs from an ordinary road; empty where nothing does. `without`: what is said elsewhere."""
        usual = Config(rules=config.rules)
        return self._chained(
            list(self._parts({name: getattr(config, name) for name in _names(config, usual)}, without or {}))
        )

    def named(self, said: Mapping[str, Any]) -> str:
        """One of several conditions, such as "in fog"; the values of `sim.evaluate.cases.VARIED`."""
        return self._chained(list(self._parts(said, {})))

    def whole(self, config: Config) -> str:
        """All that the roads are drawn from, whether it is as usual or not."""
        names = ("road", "layout", "traffic", "weather", "time_of_day", "sensor", *COUNTS.values())
        parts = {name: getattr(config, name) for name in names if getattr(config, name) is not None}
        told = [self._say("grid", columns=config.columns, rows=config.rows), *self._parts(parts, {})]
        for name, instead in (("spawn_probability", "vehicles"), ("pothole_probability", "potholes")):
            if getattr(config, instead) is None and config.layout is None:
                told.append(self._setting(name, getattr(config, name)))
        told += [self._setting(name, getattr(config, name)) for name in _NUMBERS]
        return self._chained(told)

    def _parts(self, values: Mapping[str, Any], without: Mapping[str, Any]) -> Iterator[str]:
        kinds = {name: kind for kind, name in COUNTS.items()}
        if size := {"columns", "rows"} & values.keys() - without.keys():
            for name in sorted(size):
                yield self._say(name, value=values[name])
        for name in _SAID:
            if values.get(name) is not None and name not in without:
                known = self._sayings.words("evaluation", "conditions", name)
                key = values[name] if values[name] in known else "other"
                yield self._say(name, key, value=values[name])
        for kind in KINDS:
            name = COUNTS.get(kind, "")
            if values.get(name) is not None and name not in without:
                count = values[name]
                yield self._say("count", things=self._sayings.things(kinds[name], count), count=count)
        for name in (*_DRAWN, *_NUMBERS):
            if name in values and name not in without:
                yield self._setting(name, values[name])

    def _setting(self, name: str, value: Any) -> str:
        named = self._sayings.say("settings", "names", name)
        return self._say("setting", name=named, value=value_of(self._sayings, name, value))

    def _chained(self, parts: list[str]) -> str:
        return self._sayings.chained(parts, ", ")

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("evaluation", "conditions", *keys, **parts)


def _names(config: Config, usual: Config) -> list[str]:
    """The settings that are said since they are not as usual."""
    names = ("columns", "rows", *_SAID, *COUNTS.values(), *_DRAWN, *_NUMBERS)
    found = [name for name in names if getattr(config, name) != getattr(usual, name)]
    for name, teller in _DRAWN.items():
        if name in found and teller is not None and getattr(config, teller) is not None:
            found.remove(name)
    return found
