"""Computes the chance of each choice: the share of samples without harm.

*Unharmed* means the same for every choice: the hazard is not reached, or it is met at a speed that does no
harm. Only a pothole can be met without harm; any other hazard does harm at any speed.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from sim.actions import Weather
from sim.hazard_advice import physics, samples
from sim.hazard_advice.facts import Choice, Ending, Figures, Prospect
from sim.hazard_advice.parameters import (
    FRICTION,
    GRAVITY,
    HARM,
    LATERAL,
    MARGIN_M,
    REACTION,
    SAMPLES,
    clearing_of,
    width_of,
)
from sim.types import Kind

_Z = 1.96
"""Standard errors on either side of a 95 % interval."""


def figures(hazard: Kind, distance_m: float, speed_kmh: float, weather: Weather) -> Figures:
    """Computes the figures with every quantity at its median or mean."""
    speed, reaction, friction = speed_kmh / 3.6, REACTION.middle, FRICTION[weather].middle
    lateral = float(physics.lateral_acceleration(speed, friction, LATERAL.middle))
    offset = _offset(hazard, width_of(hazard).middle)
    steering_s = float(physics.steering_time(offset, lateral))
    drawn = physics.stopping_distance(
        speed * samples.speed_ratio(), samples.reaction(), samples.friction(weather)
    )
    rank = int(0.95 * SAMPLES)
    return Figures(
        speed_ms=speed,
        time_s=distance_m / speed,
        reaction_s=reaction,
        friction=friction,
        deceleration_ms2=friction * GRAVITY,
        reaction_m=speed * reaction,
        braking_m=physics.braking_distance(speed, friction),
        stopping_m=physics.stopping_distance(speed, reaction, friction),
        stopping_most_m=float(np.partition(drawn, rank)[rank]),
        offset_m=offset,
        lateral_ms2=lateral,
        steering_s=steering_s,
        steering_m=speed * (reaction + steering_s),
        unharmed_kmh=HARM.middle if hazard is Kind.POTHOLE else 0.0,
    )


def prospects(
    hazard: Kind, distance_m: float, speed_kmh: float, weather: Weather, middle: Figures
) -> tuple[Prospect, ...]:
    """Computes the outcome of each choice, in the order of `Choice`; `middle` is the result of `figures`."""
    speed = middle.speed_ms * samples.speed_ratio()
    distance = distance_m * samples.distance_ratio(weather)
    reaction, friction = samples.reaction(), samples.friction(weather)
    lateral = physics.lateral_acceleration(speed, friction, samples.lateral_share())
    steering_s = physics.steering_time(_offset(hazard, samples.width(hazard)), lateral)
    aside_s = reaction + steering_s
    both_ms2 = friction * GRAVITY * physics.braking_left(samples.lateral_share())
    middle_ms2 = middle.deceleration_ms2 * float(physics.braking_left(LATERAL.middle))
    both = float(
        physics.speed_met_aside(middle.speed_ms, middle.reaction_s, middle_ms2, middle.steering_s, distance_m)
    )
    braked = float(physics.speed_left(middle.speed_ms, middle.reaction_s, middle.friction, distance_m))
    clears = middle.steering_m <= distance_m
    met = {
        Choice.KEEP: (speed, 3.6 * middle.speed_ms, 0.0),
        Choice.BRAKE: (
            physics.speed_left(speed, reaction, friction, distance),
            3.6 * braked,
            middle.stopping_m,
        ),
        Choice.STEER: (
            np.where(speed * aside_s <= distance, 0.0, speed),
            0.0 if clears else speed_kmh,
            middle.steering_m,
        ),
        Choice.BRAKE_AND_STEER: (
            physics.speed_met_aside(speed, reaction, both_ms2, steering_s, distance),
            3.6 * both,
            _needed_with_both(middle, middle_ms2),
        ),
    }
    unharmed_below = samples.pothole_harm() if hazard is Kind.POTHOLE else np.float64(0.0)
    found = []
    for choice, (meets, typical_kmh, needs_m) in met.items():
        harmed = meets > unharmed_below
        chance = 1.0 - int(np.count_nonzero(harmed)) / SAMPLES
        found.append(
            Prospect(
                choice=choice,
                chance=chance,
                interval=interval(chance, SAMPLES),
                ending=_ending(choice, typical_kmh, middle.unharmed_kmh),
                needs_m=needs_m,
                meets_kmh=typical_kmh,
                harm_kmh=3.6 * float(np.sum(meets, where=harmed)) / SAMPLES,
                death=float(np.mean(physics.death_risk(3.6 * meets))) if hazard is Kind.PEDESTRIAN else 0.0,
            )
        )
    return tuple(found)


def _needed_with_both(middle: Figures, braking_ms2: float) -> float:
    """Distance (m) that braking and steering at once needs: until the car is aside, or has stopped before."""
    time_s = min(middle.steering_s, middle.speed_ms / braking_ms2)
    return middle.reaction_m + middle.speed_ms * time_s - braking_ms2 * time_s * time_s / 2


def interval(share: float, count: int) -> tuple[float, float]:
    """Computes the 95 % confidence interval of a share (Wilson, 1927), which holds at 0 and 1 as well."""
    square = _Z * _Z / count
    middle = (share + square / 2) / (1 + square)
    half = _Z * sqrt(share * (1 - share) / count + square / (4 * count)) / (1 + square)
    # At 0 and 1 the bound equals the share; rounding must not move it beyond.
    return max(0.0, min(share, middle - half)), min(1.0, max(share, middle + half))


def _offset(hazard: Kind, width: physics.Number) -> physics.Number:
    """Computes the sideways distance (m) that clears the hazard, if the car heads for its middle."""
    return (clearing_of(hazard) + width) / 2 + MARGIN_M


def _ending(choice: Choice, meets_kmh: float, unharmed_kmh: float) -> Ending:
    if meets_kmh == 0.0:
        return Ending.STOPS if choice is Choice.BRAKE else Ending.CLEARS
    return Ending.CROSSES if meets_kmh <= unharmed_kmh else Ending.HITS
