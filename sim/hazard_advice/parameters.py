"""The parameters of the advice: middle, spread, unit and source of each.

A *lognormal* quantity has its median and the standard deviation of its logarithm, a *normal* one its mean
and standard deviation, a *fixed* one no spread. A value without a source is marked "assumed".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

from sim.actions import Weather
from sim.types import Kind

GRAVITY: Final = 9.81
"""m/s²"""

SAMPLES: Final = 40_000
"""Number of samples; the standard error of a share is at most 0.25 %."""
SEED: Final = 0


@dataclass(frozen=True, slots=True)
class Quantity:
    """One uncertain quantity."""

    name: str
    law: Literal["lognormal", "normal", "fixed"]
    middle: float
    spread: float
    unit: str
    source: str


REACTION: Final = Quantity(
    "reaction time",
    "lognormal",
    1.0,
    0.42,
    "s",
    "Fambro, Koppa, Picha & Fitzpatrick, Transportation Research Record 1628 (1998): to an unexpected object "
    "1.1 s in the mean and 2.0 s at the 95th percentile, which is this lognormal. Agrees with Olson & Sivak, "
    "Human Factors 28 (1986); Green, Transportation Human Factors 2 (2000) has 1.5 s for surprises.",
)
FRICTION: Final[dict[Weather, Quantity]] = {
    "clear": Quantity(
        "friction, dry road",
        "lognormal",
        0.70,
        0.12,
        "1",
        "Noon, Engineering Analysis of Vehicular Accidents (1994): dry asphalt 0.65, dry concrete 0.75.",
    ),
    "rain": Quantity(
        "friction, wet road",
        "lognormal",
        0.55,
        0.18,
        "1",
        "Noon (1994): wet asphalt 0.50, wet concrete 0.60. Wider: it hangs on speed, depth and tread.",
    ),
    "fog": Quantity(
        "friction, damp road",
        "lognormal",
        0.55,
        0.18,
        "1",
        "As for a wet road: fog leaves a film of water, and 0.4 mm is wet (Tulloch & Stocker, 2011).",
    ),
    "snow": Quantity(
        "friction, snow",
        "lognormal",
        0.22,
        0.25,
        "1",
        "Noon (1994): snow 0.20 to 0.25, ice 0.10 to 0.15. Wider, for ice below the snow.",
    ),
}
DISTANCE: Final[dict[Weather, Quantity]] = {
    weather: Quantity(
        "true distance over the one told",
        "lognormal",
        1.0,
        0.20 if weather == "fog" else 0.10,
        "1",
        "assumed: a measured distance, and twice the spread in fog. By eye people err far more, -23 % in the "
        "mean (Distance Estimation Error in a Roadway Setting, The Police Journal 82, 2009).",
    )
    for weather in FRICTION
}
SPEED: Final = Quantity(
    "true speed over the one told",
    "lognormal",
    1.0,
    0.03,
    "1",
    "assumed. UN Regulation 39 lets a speedometer show up to 10 % + 4 km/h too much and never too little; "
    "that it may show too much is not counted on.",
)
LATERAL: Final = Quantity(
    "share of the friction used in steering",
    "normal",
    0.63,
    0.20,
    "1",
    "Weir & McRuer, SAE 766060 (1976), as told by Bartlett: 61 drivers before a box dropped in the road at "
    "50 mph: 0.44 g in the mean, 0.14 g standard deviation; over a dry friction of 0.70.",
)
LATERAL_RANGE: Final = (0.10, 1.0)
"""The share is clipped to this range: nobody uses more than all the friction, and less is no steering."""
TURNING_RADIUS: Final = Quantity(
    "least turning radius", "fixed", 5.5, 0.0, "m", "assumed: a car's turning circle of 11 m."
)
WIDTH: Final[dict[Kind, Quantity]] = {
    Kind.POTHOLE: Quantity("width of a pothole", "lognormal", 0.5, 0.30, "m", "assumed."),
    Kind.BARRIER: Quantity("width of a barrier", "lognormal", 1.0, 0.35, "m", "assumed: cones to barriers."),
    Kind.PEDESTRIAN: Quantity("width of a pedestrian", "lognormal", 0.6, 0.15, "m", "assumed."),
    Kind.VEHICLE: Quantity(
        "width of a vehicle",
        "lognormal",
        1.9,
        0.10,
        "m",
        "assumed: cars 1.8 m; Directive 96/53/EC allows 2.55 m.",
    ),
    Kind.AV: Quantity("width of a vehicle", "lognormal", 1.8, 0.05, "m", "assumed: a car."),
}
CLEARING: Final[dict[Kind, float]] = {
    Kind.POTHOLE: 0.2,
    Kind.BARRIER: 1.8,
    Kind.PEDESTRIAN: 1.8,
    Kind.VEHICLE: 1.8,
    Kind.AV: 1.8,
}
"""Width (m) of what passes beside the hazard: a tyre beside a pothole, otherwise the car."""
MARGIN_M: Final = 0.3
"""Room (m) left beside the hazard (assumed)."""
HARM: Final = Quantity(
    "speed up to which a pothole does no harm",
    "lognormal",
    32.0,
    0.25,
    "km/h",
    "Zimmer & Ivey, Texas Transportation Institute 328-2F (1983): 20 mph is the lowest street speed with "
    "damage to tyres and rims, by holes over 30 in long and 3 in deep; this hole is taken to be one. "
    "The spread is assumed. For one hole they find that slower is not always better; that is left out.",
)

SPEEDS_KMH: Final = (1.0, 300.0)
DISTANCES_M: Final = (0.1, 1000.0)
"""Range of questions. Beyond it there is nothing to do, or the vehicle is no road car."""


def width_of(hazard: Kind) -> Quantity:
    """The width of a hazard; a kind that is not listed is taken to be as wide as an obstacle vehicle."""
    return WIDTH.get(hazard, WIDTH[Kind.VEHICLE])


def clearing_of(hazard: Kind) -> float:
    """Metres of what must pass beside a hazard; the car where the kind is not listed."""
    return CLEARING.get(hazard, CLEARING[Kind.VEHICLE])


def parameters(hazard: Kind, weather: Weather) -> tuple[Quantity, ...]:
    """Lists the quantities used for a hazard in this weather."""
    always = (
        REACTION,
        FRICTION[weather],
        DISTANCE[weather],
        SPEED,
        LATERAL,
        TURNING_RADIUS,
        width_of(hazard),
    )
    return (*always, HARM) if hazard is Kind.POTHOLE else always
