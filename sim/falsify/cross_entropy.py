"""The cross-entropy method over the space of scenarios.

Each generation draws points from a distribution, and the next distribution is fitted to the best of them
(the elite): the tenth with the highest scores, or every failure once there are more. A share of each
generation is still drawn uniformly, and the spread never falls below a floor, so that the search does not
lose sight of other ways to fail.

Sources: De Boer, Kroese, Mannor & Rubinstein, "A tutorial on the cross-entropy method", Annals of Operations
Research, 2005; for falsification: Sankaranarayanan & Fainekos, "Falsification of temporal properties of
hybrid systems using the cross-entropy method", HSCC 2012.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from statistics import NormalDist
from typing import Final

from sim.falsify.space import KINDS_SEARCHED, LAYOUTS, Point
from sim.randomness import Stream

ELITE: Final = 0.1
"""Share of a generation that the next one is fitted to."""
SMOOTHING: Final = 0.7
"""Weight of the elite beside the former distribution."""
EXPLORED: Final = 0.1
"""Share of a directed generation that is drawn uniformly."""
FLOOR: Final = 0.05
"""Least standard deviation of a level."""
LEAST_LAYOUT: Final = 0.02
"""Least probability of a layout."""
DIGITS: Final = 6
"""Levels are rounded, so that no machine's last digit matters."""

_NORMAL: Final = NormalDist()
_EXPLORES, _LAYOUT, _LEVELS = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Distribution:
    """Normal levels, cut off at 0 and 1, and the probability of each layout."""

    means: tuple[float, ...] = (0.5,) * len(KINDS_SEARCHED)
    spreads: tuple[float, ...] = (0.3,) * len(KINDS_SEARCHED)
    """standard deviations"""
    layouts: tuple[float, ...] = (1 / len(LAYOUTS),) * len(LAYOUTS)


def draw(distribution: Distribution | None, stream: Stream) -> Point:
    """A point, drawn uniformly without a distribution."""
    if distribution is None or stream.uniform(_EXPLORES) < EXPLORED:
        levels = [stream.uniform(_LEVELS + place) for place in range(len(KINDS_SEARCHED))]
        return Point(_rounded(levels), stream.below(len(LAYOUTS), _LAYOUT))
    levels = [
        min(1.0, max(0.0, mean + spread * _normal(stream.uniform(_LEVELS + place))))
        for place, (mean, spread) in enumerate(zip(distribution.means, distribution.spreads, strict=True))
    ]
    return Point(_rounded(levels), _chosen(distribution.layouts, stream.uniform(_LAYOUT)))


def fit(former: Distribution, points: Sequence[Point], scores: Sequence[float], top: float) -> Distribution:
    """The next distribution. `top`: the score of a failure, above which nothing is better."""
    if not points:
        return former
    ranked = sorted(range(len(points)), key=lambda place: -scores[place])
    best = max(1, round(ELITE * len(points)), sum(score >= top for score in scores))
    elite = [points[place] for place in ranked[:best]]
    means, spreads = [], []
    for place, (mean, spread) in enumerate(zip(former.means, former.spreads, strict=True)):
        levels = [point.levels[place] for point in elite]
        average = sum(levels) / len(levels)
        deviation = sqrt(sum((level - average) ** 2 for level in levels) / len(levels))
        means.append(_smoothed(average, mean))
        spreads.append(max(FLOOR, _smoothed(deviation, spread)))
    shares = [
        max(LEAST_LAYOUT, _smoothed(sum(point.layout == place for point in elite) / len(elite), share))
        for place, share in enumerate(former.layouts)
    ]
    whole = sum(shares)
    return Distribution(_rounded(means), _rounded(spreads), _rounded([share / whole for share in shares]))


def _smoothed(value: float, former: float) -> float:
    return SMOOTHING * value + (1 - SMOOTHING) * former


def _rounded(values: Sequence[float]) -> tuple[float, ...]:
    return tuple(round(value, DIGITS) for value in values)


def _normal(uniform: float) -> float:
    """A normal draw from a uniform one."""
    return _NORMAL.inv_cdf(min(1 - 1e-9, max(1e-9, uniform)))


def _chosen(shares: Sequence[float], uniform: float) -> int:
    total = 0.0
    for place, share in enumerate(shares):
        total += share
        if uniform < total:
            return place
    return len(shares) - 1
