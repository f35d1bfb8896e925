"""How likely a device detects a thing in one look, by distance and conditions; formula in `parameters`."""

from __future__ import annotations

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.perceive.parameters import SUITES, SensorSpec
from sim.types import Kind


def detection_probability(
    spec: SensorSpec, kind: Kind, weather: Weather, light: TimeOfDay, distance_m: float
) -> float:
    """The probability that a thing in plain view, at this distance (m), is detected in one look."""
    target, sky, sun = spec.targets[kind], spec.weather[weather], spec.light[light]
    reach = min(sky.reach, sun.reach)
    if distance_m > spec.range_m * reach:
        return 0.0
    peak = target.peak * sky.peak * sun.peak
    if kind is Kind.POTHOLE:
        peak *= sky.pothole * sun.pothole
    return peak / (1.0 + (distance_m / (target.half_m * reach)) ** 4)


def detection_chance(config: Config, kind: Kind, distance_m: float) -> float | None:
    """The probability that one look of the configured sensor detects a thing in plain view, right ahead.

    None for a sensor that is not described by `SUITES`.
    """
    if config.sensor not in SUITES:
        return None
    if distance_m > config.sensor_range_m:
        return 0.0
    missed = 1.0
    for spec in SUITES[config.sensor]:
        missed *= 1.0 - detection_probability(spec, kind, config.weather, config.time_of_day, distance_m)
    return 1.0 - missed
