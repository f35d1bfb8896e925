"""What weather and light do to a sensor: how far and how surely it detects things with and without them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.explain.sensing import Reach, reach
from sim.perceive.detection import detection_chance
from sim.perceive.parameters import SUITES
from sim.types import PLACEABLE, Kind

NEAR_CELLS: Final = 3
"""The distance that chances of detection are compared at."""


@dataclass(frozen=True, slots=True)
class ConditionEffect:
    """A sensor in some weather and light, beside the same sensor without what is asked about."""

    weather: Weather
    light: TimeOfDay
    now: Reach
    without: Reach
    near_m: float
    chances: Mapping[Kind, tuple[float, float]]
    """of one look, at `near_m` right ahead in plain view: with the conditions, and without"""
    more_alarms: bool
    """whether the conditions make false alarms of one of its devices more frequent"""

    @property
    def changes(self) -> bool:
        """Whether anything is detected less far or less surely."""
        return self.now != self.without or any(now != clear for now, clear in self.chances.values())


def condition_effect(
    config: Config, weather: Weather | None, light: TimeOfDay | None
) -> ConditionEffect | None:
    """What a weather, a light or both do to the configured sensor; None for one without tables (`SUITES`).

    What is not named stays as it is configured, with and without.
    """
    with_it = replace(config, weather=weather or config.weather, time_of_day=light or config.time_of_day)
    without = replace(
        with_it,
        weather="clear" if weather else with_it.weather,
        time_of_day="day" if light else with_it.time_of_day,
    )
    reaches = reach(with_it), reach(without)
    if reaches[0] is None or reaches[1] is None:
        return None
    near_m = NEAR_CELLS * config.cell_m
    return ConditionEffect(
        with_it.weather,
        with_it.time_of_day,
        reaches[0],
        reaches[1],
        near_m,
        {
            kind: (
                detection_chance(with_it, kind, near_m) or 0.0,
                detection_chance(without, kind, near_m) or 0.0,
            )
            for kind in PLACEABLE
        },
        any(
            (weather is not None and spec.weather[weather].false_alarms > 1.0)
            or (light is not None and spec.light[light].false_alarms > 1.0)
            for spec in SUITES[config.sensor]
        ),
    )
