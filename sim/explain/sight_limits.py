"""Whether the weather or the light limits a sensor more: how far it detects things with each of them away."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.explain.sensing import reach
from sim.types import Kind

Limit = Literal["weather", "light", "both", "neither"]


@dataclass(frozen=True, slots=True)
class SightLimits:
    """Cells ahead up to which one look detects a thing of a kind in at least half of the cases."""

    kind: Kind

    weather: Weather
    light: TimeOfDay
    now: int
    in_clear: int
    """in clear weather, with the light as it is"""
    by_day: int
    """by day, with the weather as it is"""
    best: int
    """in clear weather by day"""

    @property
    def limit(self) -> Limit:
        """What limits more: what it would reach farther without. `both`: equally, or only together."""
        if self.now == self.best:
            return "neither"
        if self.in_clear == self.by_day:
            return "both"
        return "weather" if self.in_clear > self.by_day else "light"


def sight_limits(config: Config, kind: Kind = Kind.VEHICLE) -> SightLimits | None:
    """What limits the configured sensor; None for one that is perfect or of another package."""
    found = [
        reach(replace(config, weather=weather, time_of_day=light))
        for weather, light in (
            (config.weather, config.time_of_day),
            ("clear", config.time_of_day),
            (config.weather, "day"),
            ("clear", "day"),
        )
    ]
    cells = [each.half[kind] for each in found if each is not None]
    if len(cells) < len(found):
        return None
    return SightLimits(kind, config.weather, config.time_of_day, *cells)
