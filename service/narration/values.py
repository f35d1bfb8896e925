"""Values of settings as people know them, with their units: "40 %", "2 cells of distance", "A*"."""

from __future__ import annotations

from service.narration.sayings import Sayings
from service.sessions.scheduler.playback_speed import MAX, PlaybackSpeed
from sim.config import Config
from sim.sensor_names import DEFAULT_SENSOR

_PERCENT_DIGITS = 9
"""Decimals of a percentage that are no rounding errors."""


def speed(sayings: Sayings, pace: PlaybackSpeed) -> str:
    """A playback speed: `4×`."""
    if pace == MAX:
        return sayings.say("replies", "speed", "max")
    return sayings.say("replies", "speed", "times", speed=sayings.number(float(pace)))


def conditions_of(sayings: Sayings, config: Config) -> str:
    """Sensor, weather and time of day, where they are not those of every road; empty where all are."""
    plain = {"sensor": DEFAULT_SENSOR, "weather": "clear", "time_of_day": "day"}
    values = {name: getattr(config, name) for name in plain}
    told = [value_of(sayings, name, value) for name, value in values.items() if value != plain[name]]
    return sayings.joined(told)


def value_of(sayings: Sayings, parameter: str, value: object) -> str:
    """The value of a setting as people know it, with its unit."""
    if parameter == "planner":
        return sayings.planner(str(value))
    known = sayings.words("replies", "values").get(parameter, {}).get(value)
    if known is not None:
        return str(known)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    units = sayings.words("replies", "units")
    if parameter not in units:
        return sayings.number(value)
    keys = ("one" if value == 1 else "many",) if isinstance(units[parameter], dict) else ()
    percent = sayings.number(round(100 * value, _PERCENT_DIGITS))
    return sayings.say("replies", "units", parameter, *keys, value=sayings.number(value), percent=percent)
