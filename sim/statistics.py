"""Confidence intervals of shares and means."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from statistics import fmean, stdev
from typing import Final

Z: Final = 1.959964
"""Standard errors on either side of a 95 % interval."""


def wilson(hits: int, tries: int) -> tuple[float, float]:
    """Computes the 95 % confidence interval of the share `hits` / `tries`; `tries` is at least 1.

    Source: Wilson, "Probable inference, the law of succession, and statistical inference", Journal of the
    American Statistical Association, 1927.
    """
    share, square = hits / tries, Z * Z
    middle = (share + square / (2 * tries)) / (1 + square / tries)
    half = Z / (1 + square / tries) * sqrt(share * (1 - share) / tries + square / (4 * tries * tries))
    return max(0.0, middle - half), min(1.0, middle + half)


def mean(values: Sequence[float]) -> tuple[float, float]:
    """Computes a mean and half its 95 % interval (normal); the half is 0 for fewer than two values."""
    half = Z * stdev(values) / sqrt(len(values)) if len(values) > 1 else 0.0
    return fmean(values), half
