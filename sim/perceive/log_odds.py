"""Log odds as whole numbers, so that beliefs are the same on every machine and cheap to compare.

A probability p is kept as round(256 · ln(p / (1 − p))), clamped to ±8 nats (0.034 % to 99.966 %), as
occupancy maps do so that a change is believed after a few looks (Hornung et al., "OctoMap", Autonomous
Robots 34, 2013).
"""

from __future__ import annotations

from math import exp, log
from typing import Final

UNITS: Final = 256
"""in one nat"""
LIMIT: Final = 8 * UNITS

PROBABILITY: Final = tuple(1.0 / (1.0 + exp(-value / UNITS)) for value in range(-LIMIT, LIMIT + 1))
"""The probability of log odds `value`, at index `value` + LIMIT."""


def log_odds(probability: float) -> int:
    """The log odds of a probability."""
    if probability <= PROBABILITY[0]:
        return -LIMIT
    if probability >= PROBABILITY[-1]:
        return LIMIT
    return round(UNITS * log(probability / (1.0 - probability)))


def clamped(value: int) -> int:
    """The nearest log odds within the limits."""
    return max(-LIMIT, min(LIMIT, value))
