"""How much traffic there is by the time of day.

The factors are judgement. Their shape is that of hourly counts as road authorities publish them: an evening
peak above the hours around noon, a morning that fills up, and a fraction of it at night. They apply to the
chance of an obstacle vehicle, since that is what traffic is drawn by; exact numbers stay as they are.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from sim.actions import TimeOfDay

DAILY_TRAFFIC: Final[Mapping[TimeOfDay, float]] = MappingProxyType(
    {"day": 1.0, "dusk": 1.2, "night": 0.3, "dawn": 0.6}
)
"""Traffic at each time of day as a multiple of that by day."""


def vehicle_probability(spawn_probability: float, time_of_day: TimeOfDay, share: float) -> float:
    """The chance of an obstacle vehicle at a time of day; never above 1.

    `share`: how much of the difference between the times of day counts, from 0 (none) to 1 (all of it).
    """
    if not share:
        return spawn_probability
    return min(1.0, spawn_probability * (1.0 + share * (DAILY_TRAFFIC[time_of_day] - 1.0)))
