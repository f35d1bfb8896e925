"""Samples of the uncertain quantities: one fixed table for all questions.

Common random numbers: all questions use the same samples. So the same question has the same answer, and
sampling noise never lowers a chance when the distance grows by a metre.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from sim.actions import Weather
from sim.hazard_advice.parameters import (
    DISTANCE,
    FRICTION,
    HARM,
    LATERAL,
    LATERAL_RANGE,
    REACTION,
    SAMPLES,
    SEED,
    SPEED,
    WIDTH,
    Quantity,
    width_of,
)
from sim.randomness import Stream, fraction, word_at
from sim.types import Kind

Column = NDArray[np.float64]

_PURPOSES: Final = ("reaction", "friction", "distance", "speed", "lateral", "width", "harm")


@lru_cache(maxsize=1)
def reaction() -> Column:
    """Reaction times in seconds (shape: `SAMPLES`, as everywhere here)."""
    return _draw_column(REACTION, "reaction")


@lru_cache(maxsize=len(FRICTION))
def friction(weather: Weather) -> Column:
    """Friction coefficients."""
    return _draw_column(FRICTION[weather], "friction")


@lru_cache(maxsize=len(DISTANCE))
def distance_ratio(weather: Weather) -> Column:
    """Ratios of the true distance to the stated one."""
    return _draw_column(DISTANCE[weather], "distance")


@lru_cache(maxsize=1)
def speed_ratio() -> Column:
    """Ratios of the true speed to the stated one."""
    return _draw_column(SPEED, "speed")


@lru_cache(maxsize=1)
def lateral_share() -> Column:
    """Shares of the friction used in steering."""
    return np.clip(_draw_column(LATERAL, "lateral"), *LATERAL_RANGE)


@lru_cache(maxsize=len(WIDTH))
def width(hazard: Kind) -> Column:
    """Widths of the hazard in metres."""
    return _draw_column(width_of(hazard), "width")


@lru_cache(maxsize=1)
def pothole_harm() -> Column:
    """Highest speeds (m/s) at which a pothole does no harm."""
    return _draw_column(HARM, "harm") / 3.6


def _draw_column(quantity: Quantity, purpose: str) -> Column:
    noise = quantity.spread * _normals(_PURPOSES.index(purpose))
    lognormal = quantity.law == "lognormal"
    drawn: Column = quantity.middle * np.exp(noise) if lognormal else quantity.middle + noise
    drawn.setflags(write=False)  # cached and shared by all questions
    return drawn


def _normals(column: int) -> Column:
    """Draws from a standard normal distribution (Box & Muller, 1958)."""
    first, second = (_uniforms(column, half) for half in (0, 1))
    normals: Column = np.sqrt(-2 * np.log1p(-first)) * np.cos(2 * np.pi * second)
    return normals


def _uniforms(column: int, half: int) -> Column:
    """Draws from [0, 1), by the project's random streams on a whole array."""
    index: Any = np.arange(SAMPLES, dtype=np.uint64)
    drawn: Any = fraction(word_at(Stream.of(SEED, "advice", column, half).key, index))
    uniforms: Column = drawn
    return uniforms
