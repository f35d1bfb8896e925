"""Braking distances by surface and speed, beside those of published tables of friction.

    python -m tools.stopping_by_surface

Printed: the braking distance (m) with the middle friction of the advice and, in parentheses, between those
with the highest and the lowest friction that the table has for such a surface.
"""

from __future__ import annotations

import sys
from typing import Final

from sim.actions import Weather
from sim.hazard_advice.parameters import FRICTION
from sim.hazard_advice.physics import braking_distance
from tools.published_stopping import HIGHWAY_CODE, NOON_FRICTION

SPEEDS_KMH: Final = (30, 50, 80, 100, 120)
MS_PER_MPH: Final = 0.44704
SURFACES: Final[dict[str, Weather]] = {"dry": "clear", "wet": "rain", "snow": "snow"}


def braking(weather: Weather, kmh: float) -> tuple[float, float, float]:
    """Braking distance (m) of the advice, and the shortest and the longest of the published friction."""
    speed, (least, most) = kmh / 3.6, NOON_FRICTION[weather]
    ours = braking_distance(speed, FRICTION[weather].middle)
    return float(ours), float(braking_distance(speed, most)), float(braking_distance(speed, least))


def main() -> int:
    """Print the tables. Returns 1 where a distance is not between the published ones."""
    outside = 0
    print(f"| surface | {' | '.join(f'{kmh} km/h' for kmh in SPEEDS_KMH)} |")
    print("| --- " * (1 + len(SPEEDS_KMH)) + "|")
    for surface, weather in SURFACES.items():
        row = [braking(weather, kmh) for kmh in SPEEDS_KMH]
        outside += sum(not low <= ours <= high for ours, low, high in row)
        cells = (f"{ours:.1f} ({low:.1f} to {high:.1f})" for ours, low, high in row)
        print(f"| {surface} | {' | '.join(cells)} |")
    print("\n| mph | Highway Code | dry |\n| --- | --- | --- |")
    for mph, (_, printed) in HIGHWAY_CODE.items():
        ours = braking_distance(mph * MS_PER_MPH, FRICTION["clear"].middle)
        print(f"| {mph} | {printed} | {ours:.0f} |")
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(main())
