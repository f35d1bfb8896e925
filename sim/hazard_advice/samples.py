"""The draws: one fixed table for all questions.

Every question is asked of the same drivers on the same roads, so that the same question has the same
answer, and a metre more never lowers a chance by the luck of the draw.
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
    SPEED,
    WIDTH,
    Quantity,
    width_of,
)
from sim.randomness import Stream, fraction, word_at
from sim.types import Kind

Column = NDArray[np.float64]

SAMPLES: Final = 40_000
"""The standard error of a share is at most 0.25 %."""
SEED: Final = 0

_PURPOSES: Final = ("reaction", "friction", "distance", "speed", "lateral", "width", "harm")


@lru_cache(maxsize=1)
def reaction() -> Column:
    """Seconds."""
    return _drawn(REACTION, "reaction")


@lru_cache(maxsize=len(FRICTION))
def friction(weather: Weather) -> Column:
    """Friction coefficients."""
    return _drawn(FRICTION[weather], "friction")


@lru_cache(maxsize=len(DISTANCE))
def distance_ratio(weather: Weather) -> Column:
    """True distance over the one told."""
    return _drawn(DISTANCE[weather], "distance")


@lru_cache(maxsize=1)
def speed_ratio() -> Column:
    """True speed over the one told."""
    return _drawn(SPEED, "speed")


@lru_cache(maxsize=1)
def lateral_share() -> Column:
    """Share of the friction used in steering."""
    return np.clip(_drawn(LATERAL, "lateral"), *LATERAL_RANGE)


@lru_cache(maxsize=len(WIDTH))
def width(hazard: Kind) -> Column:
    """Metres."""
    return _drawn(width_of(hazard), "width")


@lru_cache(maxsize=1)
def pothole_harm() -> Column:
    """Metres per second up to which a pothole does no harm."""
    return _drawn(HARM, "harm") / 3.6


def _drawn(quantity: Quantity, purpose: str) -> Column:
    noise = quantity.spread * _normals(_PURPOSES.index(purpose))
    lognormal = quantity.law == "lognormal"
    drawn: Column = quantity.middle * np.exp(noise) if lognormal else quantity.middle + noise
    drawn.setflags(write=False)  # shared by all questions
    return drawn


def _normals(column: int) -> Column:
    """Standard normal draws (Box & Muller, 1958)."""
    first, second = (_uniforms(column, half) for half in (0, 1))
    normals: Column = np.sqrt(-2 * np.log1p(-first)) * np.cos(2 * np.pi * second)
    return normals


def _uniforms(column: int, half: int) -> Column:
    """Numbers in [0, 1): the project's random words, of which an array can be had at once."""
    index: Any = np.arange(SAMPLES, dtype=np.uint64)
    drawn: Any = fraction(word_at(Stream.of(SEED, "advice", column, half).key, index))
    uniforms: Column = drawn
    return uniforms
