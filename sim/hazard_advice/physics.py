"""Textbook formulas for stopping and for steering round a hazard, for numbers and for arrays.

Stopping: d = v·t + v²/(2·μ·g), the stopping sight distance of AASHTO's *A Policy on Geometric Design of
Highways and Streets* (Green Book) with a deceleration of μ·g. Steering: a constant lateral acceleration a
moves the car aside by y in the time sqrt(2·y/a), as in Jansson, *Collision Avoidance Theory* (2005). The
turning radius limits a.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from sim.hazard_advice.parameters import GRAVITY, TURNING_RADIUS

Number: TypeAlias = Any
"""A float or an array of floats."""


def braking_distance(speed_ms: Number, friction: Number) -> Number:
    """Distance (m) from the start of braking to the stop."""
    return speed_ms * speed_ms / (2 * friction * GRAVITY)


def stopping_distance(speed_ms: Number, reaction_s: Number, friction: Number) -> Number:
    """Distance (m) from the sight of the hazard to the stop, reaction included."""
    return speed_ms * reaction_s + braking_distance(speed_ms, friction)


def speed_left(speed_ms: Number, reaction_s: Number, friction: Number, distance_m: Number) -> Number:
    """Speed (m/s) while braking, `distance_m` after the sight of the hazard; 0 after the stop."""
    braked_m = np.maximum(distance_m - speed_ms * reaction_s, 0.0)
    return np.sqrt(np.maximum(speed_ms * speed_ms - 2 * friction * GRAVITY * braked_m, 0.0))


def lateral_acceleration(speed_ms: Number, friction: Number, share: Number) -> Number:
    """Lateral acceleration (m/s²): limited by friction and driver, at low speed by the turning radius."""
    return np.minimum(share * friction * GRAVITY, speed_ms * speed_ms / TURNING_RADIUS.middle)


def steering_time(offset_m: Number, lateral_ms2: Number) -> Number:
    """Time (s) from the start of steering until the car has moved aside."""
    return np.sqrt(2 * offset_m / lateral_ms2)


def braking_left(share: Number) -> Number:
    """Share of the friction left for braking while this share is used in steering (the friction circle)."""
    return np.sqrt(np.maximum(1.0 - share * share, 0.0))


def speed_met_aside(
    speed_ms: Number, reaction_s: Number, braking_ms2: Number, aside_s: Number, distance_m: Number
) -> Number:
    """Speed (m/s) at the hazard of a car that brakes and moves aside; 0 if it is clear of it or has stopped.

    `aside_s`: seconds of steering until it is clear.
    """
    room = np.maximum(distance_m - speed_ms * reaction_s, 0.0)
    left = np.sqrt(np.maximum(speed_ms * speed_ms - 2 * braking_ms2 * room, 0.0))
    there_s = 2 * room / (speed_ms + left)
    return np.where((speed_ms * reaction_s <= distance_m) & (there_s >= aside_s), 0.0, left)


def death_risk(speed_kmh: Number) -> Number:
    """Risk that a person on foot dies when hit at this speed; 0 where nobody is hit.

    Rosén & Sander, "Pedestrian fatality risk as a function of car impact speed", Accident Analysis and
    Prevention 41 (2009): 1 / (1 + exp(6.9 - 0.090 v)), from 2,127 people in the German in-depth study GIDAS.
    """
    return np.where(speed_kmh > 0.0, 1.0 / (1.0 + np.exp(6.9 - 0.090 * speed_kmh)), 0.0)
