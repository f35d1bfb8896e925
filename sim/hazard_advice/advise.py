"""Chooses the advice: the best chance; before people on foot the least expected harm."""

from __future__ import annotations

from typing import Final

from sim.actions import Weather
from sim.hazard_advice.facts import Advice, NoAdviceError, Prospect
from sim.hazard_advice.parameters import DISTANCES_M, SAMPLES, SPEEDS_KMH
from sim.types import Kind

SURE_OF_KEEPING: Final = 0.995
"""From this chance on it is advised to keep on: it hangs on the speed alone, whatever the distance."""
SERIOUS: Final = 0.11
"""What a serious injury counts against a death. UK Department for Transport, values of preventing a casualty:
178,160 of 1,585,510 pounds in 2009 (11.2 %), 102,880 of 902,500 in 1997 (11.4 %). iRAP counts 25 % in its
assessments; that 11 % is used is a judgement. Whoever is hit counts as one."""


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
    """Keeps on where that is safe by the speed alone, brakes where that is sure; else does the least harm.

    Braking is sure in a region that only shrinks with less room or more speed, so that the advice never
    becomes gentler there. Chances count in whole hundredths, so that the chance that is stated never falls
    with more room or less speed merely because a gentler choice was taken. Among equals the least speed of
    harm counts, then the effort.
    """
    keep, *others = found
    if hazard is Kind.POTHOLE and keep.chance >= SURE_OF_KEEPING:
        return keep
    brake = others[0]
    if brake.sure:
        return brake
    if hazard is Kind.PEDESTRIAN:
        return min(others, key=lambda each: (round(expected_harm(each), 3), -round(each.chance, 2)))
    return min(others, key=lambda each: (-round(each.chance, 2), round(each.harm_kmh)))


def expected_harm(prospect: Prospect) -> float:
    """Expected harm to a person on foot: a death counts 1, any other hit `SERIOUS`."""
    return prospect.death + SERIOUS * (1.0 - prospect.chance - prospect.death)
