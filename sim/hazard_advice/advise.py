"""Chooses the advice: the choice with the best chance; among equal chances the gentlest."""

from __future__ import annotations

from typing import Final

from sim.actions import Weather
from sim.hazard_advice.facts import Advice, Choice, NoAdviceError, Prospect
from sim.hazard_advice.parameters import DISTANCES_M, SAMPLES, SPEEDS_KMH
from sim.types import Kind

EVEN_CHANCE: Final = 0.05
"""Chances that differ by less count as equal, since traffic beside and behind is not known."""
EVEN_HARM_KMH: Final = 2.0
"""Choices whose mean speed of harm (km/h) differs by no more count as equally harmful."""


def advise(hazard: Kind, distance_m: float, speed_kmh: float, weather: Weather = "clear") -> Advice:
    """Advises about a hazard straight ahead, `distance_m` metres away, at `speed_kmh` km/h.

    Raises `NoAdviceError` for a distance or speed out of range (`DISTANCES_M`, `SPEEDS_KMH`).
    """
    for field, value, (low, high), code in (
        ("distance_m", distance_m, DISTANCES_M, "distance_out_of_range"),
        ("speed_kmh", speed_kmh, SPEEDS_KMH, "speed_out_of_range"),
    ):
        if not low <= value <= high:
            raise NoAdviceError(code, field, low=low, high=high, value=value)
    # Needs numpy, which programs that never ask for advice do without.
    from sim.hazard_advice.chances import figures, prospects

    middle = figures(hazard, distance_m, speed_kmh, weather)
    found = prospects(hazard, distance_m, speed_kmh, weather, middle)
    return Advice(
        hazard=hazard,
        distance_m=distance_m,
        speed_kmh=speed_kmh,
        weather=weather,
        choice=_best(hazard, found).choice,
        prospects=found,
        figures=middle,
        samples=SAMPLES,
    )


def _best(hazard: Kind, found: tuple[Prospect, ...]) -> Prospect:
    """Orders by the best chance, then the least speed of harm, then the least effort."""
    open_ = [each for each in found if each.choice is not Choice.KEEP or hazard is Kind.POTHOLE]
    most = max(each.chance for each in open_)
    even = [each for each in open_ if each.chance > most - EVEN_CHANCE]
    least = min(each.harm_kmh for each in even)
    return next(each for each in even if each.harm_kmh <= least + EVEN_HARM_KMH)
