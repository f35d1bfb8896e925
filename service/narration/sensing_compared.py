"""Answers about sensors and weathers beside one another: which is best, whether driving changes with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, get_args

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.values import conditions_of, value_of
from service.sessions.facts import Asked
from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.explain.planners import planner_of
from sim.explain.sensing import reach
from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES
from sim.plan import traits_of
from sim.state import SimState
from sim.types import Kind


class SensingCompared:
    """Answers to "do you drive more carefully in fog?", "which weather is worst?", "which is best?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        if ask.what == "weathers":
            text, facts = self._weathers(state, None if ask.value is None else str(ask.value))
        else:
            words = (asked.supposes or "").split()
            text, facts = self._care(state) if ask.what == "care" else self._sensors(state, words)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _care(self, state: SimState) -> tuple[str, Json]:
        """No first: the rules are the same; then what the sensor detects now and at its best."""
        config = state.config
        told = [Part(0, self._say("care", "rule"))]
        now, best = half_m(config), half_m(at_its_best(config))
        if sensor_named(config.sensor).faithful:
            told.append(Part(0, self._say("care", "perfect")))
        else:
            if now is not None and best is not None and now < best:
                key = "now" if now else "none"
                told.append(
                    Part(0, self._say("care", key, metres=self._metres(now), clear=self._metres(best)))
                )
            weighs = traits_of(planner_of(state)).weighs_costs
            told.append(Part(1, self._say("care", "weighs" if weighs else "heedless")))
        if config.slips:
            percent = self._sayings.number(round(100 * config.slips, 1))
            told.append(Part(0, self._say("care", "slips", percent=percent)))
        return within(told), {"half_detected_m": now, "half_detected_clear_m": best, "slips": config.slips}

    def _weathers(self, state: SimState, sensor: str | None) -> tuple[str, Json]:
        """How far a sensor detects a car by day in each weather, and at night; the worst of them.

        `sensor`: None for the session's.
        """
        config = state.config if sensor is None else replace(state.config, sensor=sensor)
        if sensor_named(config.sensor).faithful:
            return self._say("weathers", "perfect"), {"half_detected_m": None}
        if config.sensor not in SUITES:
            return self._say("weathers", "unknown", sensor=config.sensor), {"half_detected_m": None}
        best = at_its_best(config)
        weathers: tuple[Weather, ...] = get_args(Weather)
        found = {
            value_of(self._sayings, "weather", each): half_m(replace(best, weather=each)) or 0.0
            for each in weathers
        }
        found[value_of(self._sayings, "time_of_day", "night")] = (
            half_m(replace(best, time_of_day="night")) or 0.0
        )
        name = value_of(self._sayings, "sensor", config.sensor)
        worst = [each for each, metres in found.items() if metres == min(found.values())]
        told = self._say("weathers", "told", sensor=name, listed=_listed(self._sayings, found))
        text = f"{told} {self._say('weathers', 'worst', worst=self._sayings.joined(worst))}"
        return text, {"half_detected_m": found}

    def _sensors(self, state: SimState, words: Sequence[str] = ()) -> tuple[str, Json]:
        """How far each sensor detects a car in the conditions that were named, else in the present ones."""
        config, facts = conditions_said(state.config, words)
        told, found = sensors_listed(self._sayings, config)
        return f"{told} {self._say('sensors', 'perfect')}", {"half_detected_m": found} | facts

    def _metres(self, metres: float) -> str:
        return self._sayings.number(round(metres, 1))

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("sensing_compared", *keys, **parts)


def sensors_listed(sayings: Sayings, config: Config) -> tuple[str, dict[str, float]]:
    """How far each sensor detects a car in the conditions of a configuration, and which does so farthest."""
    found = {
        value_of(sayings, "sensor", name): half_m(replace(config, sensor=name)) or 0.0 for name in SUITES
    }
    conditions = conditions_of(sayings, replace(config, sensor="perfect"))
    best = [name for name, metres in found.items() if metres == max(found.values())]
    told = sayings.say(
        "sensing_compared",
        "sensors",
        "told",
        conditions=conditions or sayings.say("sensing_compared", "plain"),
        listed=_listed(sayings, found),
    )
    return f"{told} {sayings.say('sensing_compared', 'sensors', 'best', best=sayings.joined(best))}", found


def conditions_said(config: Config, words: Sequence[str]) -> tuple[Config, Json]:
    """A configuration in the weather and light that a question names; with none, as they are.

    Of what is named the rest is plain: "in fog" is in fog by day. Also what is supposed, as facts.
    """
    weather = next((each for each in get_args(Weather) if each in words), None)
    light = next((each for each in get_args(TimeOfDay) if each in words), None)
    if weather is None and light is None:
        return config, {}
    supposed = {"weather": weather or "clear", "time_of_day": light or "day"}
    return config.with_parts(**supposed), {"supposed": supposed}


def _listed(sayings: Sayings, found: Mapping[str, float]) -> str:
    """Names with metres."""
    parts = [
        sayings.say("sensing_compared", "one", name=name, metres=sayings.number(round(metres, 1)))
        for name, metres in found.items()
    ]
    return sayings.listed(parts)


def at_its_best(config: Config) -> Config:
    """The configuration in the conditions in which sensors detect most."""
    return replace(config, weather="clear", time_of_day="day")


def half_m(config: Config) -> float | None:
    """Metres up to which one look detects a car in half of the cases; None for a sensor without tables."""
    found = reach(config)
    return None if found is None else found.half[Kind.VEHICLE] * config.cell_m
