"""Answers about what limits the sensors, how weather and light are simulated, and who chose the sensor."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.sensing_compared import conditions_said, sensors_listed
from service.narration.values import conditions_of, value_of
from service.sessions.facts import Asked
from sim.explain.sensing import reach
from sim.explain.sight_limits import SightLimits, sight_limits
from sim.perceive.parameters import SUITES, Effect, SensorSpec
from sim.perceive.registry import sensor_named
from sim.state import SimState
from sim.types import Kind

DEVICES: Final = SUITES["fusion"]
"""All devices there are."""
DEFAULT_CONDITION: Final = "fog"
"""What is told of where neither a condition is named nor one holds."""


class SensorEffects:
    """Answers to "is it the dark or the fog?", "how is fog simulated?", "how can you drive in fog?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        tell = {
            "limits": self._limits,
            "model": self._model,
            "coping": self._coping,
            "sensor_choice": self._choice,
        }[str(ask.what)]
        text, facts = tell(state, (asked.supposes or "").split())
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _limits(self, state: SimState, words: list[str]) -> tuple[str, Json]:
        """Weather or light first; then how far a car is detected without each."""
        named = next((each for each in words if each in SUITES), None)
        config = state.config if named is None else replace(state.config, sensor=named)
        if sensor_named(config.sensor).faithful:
            return self._say("limits", "perfect"), {"limit": "neither"}
        found = sight_limits(config)
        if found is None:
            return self._say("unknown", sensor=config.sensor), {"limit": None}
        told = [Part(0, self._absent(state, [each for each in words if each != named]))]
        if named is not None:
            told.append(Part(0, self._say("limits", "of", sensor=value_of(self._sayings, "sensor", named))))
        told.append(Part(0, self._which(found, state)))
        holes = sight_limits(config, Kind.POTHOLE)
        if found.limit == "neither" and holes is not None and holes.limit != "neither":
            # One device may see cars all the same, and none sees potholes.
            told.append(Part(0, self._which(holes, state)))
        return within([each for each in told if each.text]), {
            "limit": found.limit,
            "half_detected_cells": {
                "now": found.now,
                "in_clear": found.in_clear,
                "by_day": found.by_day,
                "best": found.best,
            },
        }

    def _absent(self, state: SimState, words: list[str]) -> str:
        """That what was asked about does not hold here; empty where it does."""
        config = state.config
        gone = [each for each in words if each not in (config.weather, config.time_of_day)]
        return (
            self._say("not_now", conditions=self._named(config.weather, config.time_of_day)) if gone else ""
        )

    def _which(self, found: SightLimits, state: SimState) -> str:
        weather, light = self._condition(found.weather), self._condition(found.light)
        cell_m = state.config.cell_m
        metres = {
            name: self._sayings.number(cells * cell_m)
            for name, cells in (
                ("now", found.now),
                ("in_clear", found.in_clear),
                ("by_day", found.by_day),
                ("best", found.best),
            )
        }
        metres["a"] = self._sayings.say("words", "a", found.kind)
        if found.weather == "clear" and found.light == "day":
            return self._say("limits", "none", **metres)
        if found.weather == "clear" or found.light == "day":
            one = weather if found.light == "day" else light
            key = "no_matter" if found.limit == "neither" else "one"
            return self._say("limits", key, one=one, **metres)
        return self._say("limits", found.limit, weather=weather, light=light, **metres)

    def _named(self, weather: str, light: str) -> str:
        return self._sayings.joined([self._condition(weather), self._condition(light)])

    def _condition(self, name: str) -> str:
        return self._say("conditions", name)

    def _model(self, state: SimState, words: list[str]) -> tuple[str, Json]:
        """What a condition does to each device: reach, chance of detection, false alarms."""
        named = [each for each in words if each in self._sayings.words("sensor_effects", "model_of")]
        config = state.config
        here = config.weather if config.weather != "clear" else config.time_of_day
        condition = named[0] if named else here if here != "day" else DEFAULT_CONDITION
        effects = {spec.name: _effect(spec, condition) for spec in DEVICES}
        told = [
            Part(0, self._say("model", "told", condition=self._say("model_of", condition))),
            Part(0, self._share("reach", effects, "reach")),
            Part(0, self._share("chance", effects, "peak")),
        ]
        if any(each.false_alarms > 1 for each in effects.values()):
            told.append(Part(1, self._say("model", "alarms")))
        if condition == "snow":
            percent = self._percent(config.slip_probability)
            told.append(Part(1, self._say("model", "slips", percent=percent)))
        return within(told), {
            "condition": condition,
            "effects": {
                name: {"reach": each.reach, "peak": each.peak, "false_alarms": each.false_alarms}
                for name, each in effects.items()
            },
        }

    def _share(self, key: str, effects: Mapping[str, Effect], field: str) -> str:
        listed = [
            self._say(
                "model",
                "one",
                sensor=value_of(self._sayings, "sensor", name),
                percent=self._percent(getattr(each, field)),
            )
            for name, each in effects.items()
        ]
        return self._say("model", key, listed=self._sayings.joined(listed))

    def _coping(self, state: SimState, words: list[str]) -> tuple[str, Json]:
        """How it drives where little is seen: what it detects, what it remembers, what counts as taken."""
        config = state.config
        if sensor_named(config.sensor).faithful:
            return self._say("coping", "perfect"), {"half_detected_cells": None}
        found = reach(config)
        if found is None:
            return self._say("unknown", sensor=config.sensor), {"half_detected_cells": None}
        metres = {
            name: self._sayings.number(found.half[kind] * config.cell_m)
            for name, kind in (("car", Kind.VEHICLE), ("pothole", Kind.POTHOLE))
        }
        told = [
            Part(0, self._absent(state, words)),
            Part(0, self._say("coping", "how", conditions=conditions_of(self._sayings, config))),
            Part(0, self._say("coping", "far", **metres)),
            Part(
                1, self._say("coping", "threshold", percent=self._percent(1 - config.detection_sensitivity))
            ),
            Part(2, self._say("coping", "risk")),
        ]
        half = {kind.value: cells for kind, cells in found.half.items()}
        return within([each for each in told if each.text]), {"half_detected_cells": half}

    def _choice(self, state: SimState, words: list[str]) -> tuple[str, Json]:
        """That the sensor is set by people; how far each would detect a car in these conditions."""
        config, facts = conditions_said(state.config, words)
        sensor = value_of(self._sayings, "sensor", state.config.sensor)
        listed, found = sensors_listed(self._sayings, config)
        told = [Part(0, self._say("choice", "set", sensor=sensor)), Part(0, listed)]
        return within(told), {"sensor": state.config.sensor, "half_detected_m": found} | facts

    def _percent(self, share: float) -> str:
        return self._sayings.number(round(100 * share, 1))

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("sensor_effects", *keys, **parts)


def _effect(spec: SensorSpec, condition: str) -> Effect:
    """What a condition does to a device."""
    effects = (*spec.weather.items(), *spec.light.items())
    return next(effect for name, effect in effects if name == condition)
