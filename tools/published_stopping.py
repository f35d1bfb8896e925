"""Published figures of stopping and of injury, to hold the advice against."""

from __future__ import annotations

from typing import Final

HIGHWAY_CODE: Final = {20: (6, 6), 30: (9, 14), 40: (12, 24), 50: (15, 38), 60: (18, 55), 70: (21, 75)}
"""The Highway Code, rule 126, "typical stopping distances": mph → thinking and braking distance, m."""

GREEN_BOOK: Final = {
    20: 20, 30: 35, 40: 50, 50: 65, 60: 85, 70: 105, 80: 130, 90: 160, 100: 185, 110: 220, 120: 250, 130: 285,
}  # fmt: skip
"""AASHTO Green Book (2001 on), design stopping sight distance on level roads: km/h → m, rounded up to 5 m.
Made from 2.5 s of reaction and a deceleration of 3.4 m/s²."""

NOON_FRICTION: Final = {"clear": (0.65, 0.75), "rain": (0.50, 0.60), "snow": (0.20, 0.25)}
"""Noon, Engineering Analysis of Vehicular Accidents (CRC Press, 1994): friction of dry asphalt and concrete,
of both when wet, and of snow, from the lowest to the highest."""

TEFFT_DEATH: Final = {38.8: 0.10, 52.3: 0.25, 65.3: 0.50, 77.2: 0.75, 87.9: 0.90}
"""Tefft, Accident Analysis and Prevention 50 (2013), average risk of death of a person on foot in the United
States: impact speed in km/h (24.1, 32.5, 40.6, 48.0 and 54.6 mph) → risk."""

ROSEN_SANDER_RATIOS: Final = {(50, 40): 2.0, (50, 30): 5.0}
"""Rosén & Sander (2009), abstract: the risk at the first speed (km/h) is more than so many times that at the
second."""

RSS_RESPONSE_S: Final = 1.0
RSS_ACCELERATION_MS2: Final = 3.5
RSS_BRAKING_MS2: Final = 4.0
"""Common settings of the open library ad-rss-lib and of CARLA; the paper leaves them open."""


def rss_distance(
    speed_ms: float,
    response_s: float = RSS_RESPONSE_S,
    acceleration_ms2: float = RSS_ACCELERATION_MS2,
    braking_ms2: float = RSS_BRAKING_MS2,
) -> float:
    """Safe distance (m) behind something that stands still.

    Responsibility-Sensitive Safety (Shalev-Shwartz, Shammah & Shashua, 2017, definition 1 with a leading
    speed of 0): the car speeds up during the response, then brakes as gently as it may.
    """
    faster = speed_ms + response_s * acceleration_ms2
    return speed_ms * response_s + acceleration_ms2 * response_s**2 / 2 + faster**2 / (2 * braking_ms2)
