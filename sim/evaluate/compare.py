"""Two planners on the same roads, pair by pair: effect sizes first, then what chance alone would do.

Success is compared by McNemar's exact test, times by the sign test of the roads on which both arrived.
Intervals are percentile bootstraps of the pairs with a fixed seed: the pairs fall into a few classes, so
that resampling them is drawing from a multinomial distribution, however many there are (Efron & Tibshirani,
*An Introduction to the Bootstrap*, 1993).
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from sim.evaluate.rows import ARRIVED, Rows
from sim.evaluate.spec import Evaluation
from sim.statistics import mcnemar, pairs_needed

RESAMPLES: Final = 4_000
SEED: Final = 20_250
"""Of the generator that resamples."""
LEVEL: Final = 0.05
MOST_NEEDED: Final = 10_000_000
"""Pairs above which no sample size is advised: the difference would not matter."""


def compare(spec: Evaluation, planners: tuple[str, str], rows: Rows) -> dict[str, Any]:
    """How the first of two planners differs from the second, as JSON values."""
    first, second = (rows[planner]["outcome"] == ARRIVED for planner in planners)
    table = [int(each.sum()) for each in (first & second, first & ~second, ~first & second, ~first & ~second)]
    both, only_first, only_second, neither = table
    difference = (only_first - only_second) / spec.episodes
    low, high = interval(np.array([0, 1, -1, 0]), np.array(table))
    p_value = mcnemar(only_first, only_second)
    return {
        "first": planners[0],
        "second": planners[1],
        "both": both,
        "only_first": only_first,
        "only_second": only_second,
        "neither": neither,
        "difference": {"share": difference, "low": low, "high": high},
        "odds_ratio": only_first / only_second if only_second else None,
        "p_value": p_value,
        "settled": p_value < LEVEL,
        "more_runs": _more_runs(spec, only_first, only_second, p_value),
        "seconds": _times(spec, planners, rows, first & second),
    }


def interval(values: NDArray[Any], counts: NDArray[Any]) -> tuple[float, float]:
    """The 95 % interval of the mean of values that occur so often, by bootstrap."""
    total = int(counts.sum())
    generator = np.random.Generator(np.random.PCG64(SEED))
    drawn = generator.multinomial(total, counts / total, size=RESAMPLES)
    means = drawn @ values / total
    low, high = np.quantile(means, (0.025, 0.975))
    return round(float(low), 9), round(float(high), 9)


def _times(
    spec: Evaluation, planners: tuple[str, str], rows: Rows, both: NDArray[np.bool_]
) -> dict[str, Any] | None:
    """Seconds that the first takes more than the second where both arrive; None where they never do."""
    if not both.any():
        return None
    ticks = [rows[planner]["ticks"][both].astype(int) for planner in planners]
    more, counts = np.unique(ticks[0] - ticks[1], return_counts=True)
    step_s = spec.config.step_seconds
    low, high = interval(more * step_s, counts)
    faster, slower = int(counts[more < 0].sum()), int(counts[more > 0].sum())
    return {
        "pairs": int(counts.sum()),
        "mean": round(float((more * counts).sum()) * step_s / int(counts.sum()), 6),
        "low": low,
        "high": high,
        "first_faster": faster,
        "second_faster": slower,
        "p_value": mcnemar(faster, slower),
    }


def _more_runs(spec: Evaluation, only_first: int, only_second: int, p_value: float) -> int | None:
    """How many more runs would tell whether the difference in success is one; None where none are advised."""
    if p_value < LEVEL or spec.alike:
        return None
    needed = pairs_needed(
        (only_first + only_second) / spec.episodes, (only_first - only_second) / spec.episodes
    )
    if needed is None or needed > MOST_NEEDED:
        return None
    return max(1, needed - spec.episodes)
