"""Stopping and steering round, by the textbook; on single numbers and on arrays of them alike.

Stopping: d = v·t + v²/(2·μ·g), the stopping sight distance of AASHTO's *A Policy on Geometric Design of
Highways and Streets* (Green Book) with a deceleration of μ·g. Steering: constant lateral acceleration a
moves aside by y in sqrt(2·y/a), as in the required lateral acceleration of Jansson, *Collision Avoidance
Theory* (2005); no tighter than the car can turn.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from sim.hazard_advice.parameters import GRAVITY, TURNING_RADIUS

Number: TypeAlias = Any
"""A float, or an array of them."""


def braking_distance(speed_ms: Number, friction: Number) -> Number:
    """Metres from the first braking to the stop."""
    return speed_ms * speed_ms / (2 * friction * GRAVITY)


def stopping_distance(speed_ms: Number, reaction_s: Number, friction: Number) -> Number:
    """Metres from the sight of the hazard to the stop."""
    return speed_ms * reaction_s + braking_distance(speed_ms, friction)


def speed_left(speed_ms: Number, reaction_s: Number, friction: Number, distance_m: Number) -> Number:
    """Speed at a distance from where the hazard came in sight, when braking; 0 where it is not reached."""
    braked_m = np.maximum(distance_m - speed_ms * reaction_s, 0.0)
    return np.sqrt(np.maximum(speed_ms * speed_ms - 2 * friction * GRAVITY * braked_m, 0.0))


def lateral_acceleration(speed_ms: Number, friction: Number, share: Number) -> Number:
    """How hard the car is steered: by grip and driver, at low speed by the least turning radius."""
    return np.minimum(share * friction * GRAVITY, speed_ms * speed_ms / TURNING_RADIUS.middle)


def steering_time(offset_m: Number, lateral_ms2: Number) -> Number:
    """Seconds from the first steering until the car has moved aside."""
    return np.sqrt(2 * offset_m / lateral_ms2)
