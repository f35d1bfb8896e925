"""The figures of an evaluation: rates with intervals, times, moves, closeness, and what failed."""

from __future__ import annotations

from collections.abc import Callable
from math import isnan
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from sim.evaluate.compare import compare
from sim.evaluate.failures import examples
from sim.evaluate.rows import ARRIVED, CRASHED, NO_WAY, ROADS, STUCK, UNKNOWN, WAY, Columns, Rows
from sim.evaluate.spec import Evaluation
from sim.statistics import Z, wilson

VERSION: Final = 1
"""Of the form of a summary."""
DIAGONAL: Final = 2**0.5


def summarize(
    spec: Evaluation, rows: Rows, cancelled: Callable[[], bool] = lambda: False, *, look: bool = True
) -> dict[str, Any]:
    """All figures as JSON values; the same for the same evaluation. `look`: drive examples again."""
    roads = rows[ROADS]
    comparisons = [compare(spec, (spec.planners[0], other), rows) for other in spec.planners[1:]]
    return {
        "version": VERSION,
        "episodes": spec.episodes,
        "alike": spec.alike,
        "roads": {
            "solvable": int((roads["solvable"] == WAY).sum()),
            "unsolvable": int((roads["solvable"] == NO_WAY).sum()),
            "unknown": int((roads["solvable"] == UNKNOWN).sum()),
        },
        "planners": {planner: _figures(spec, rows[planner], roads) for planner in spec.planners},
        "comparisons": comparisons,
        "examples": [each.to_json() for each in examples(spec, rows, cancelled)] if look else [],
    }


def share(hits: int, tries: int) -> dict[str, Any]:
    """A count as a share with its 95 % interval (Wilson)."""
    low, high = wilson(hits, tries) if tries else (0.0, 1.0)
    low, high = low if hits else 0.0, high if hits < tries else 1.0  # without rounding
    return {
        "count": hits,
        "of": tries,
        "share": hits / tries if tries else None,
        "low": low,
        "high": high,
    }


def _figures(spec: Evaluation, columns: Columns, roads: Columns) -> dict[str, Any]:
    outcome, config = columns["outcome"], spec.config
    arrived, ways = outcome == ARRIVED, roads["solvable"] != NO_WAY
    metres = config.cell_m * (
        columns["forward"].astype(int) + columns["sideways"] + DIAGONAL * columns["diagonal"]
    )
    names = ("forward", "sideways", "diagonal", "stay")
    moves = {name: int(columns[name][arrived].sum(dtype=np.int64)) for name in names}
    return {
        "arrived": share(int(arrived.sum()), spec.episodes),
        "crashed": share(int((outcome == CRASHED).sum()), spec.episodes),
        "stuck": share(int((outcome == STUCK).sum()), spec.episodes),
        "arrived_where_possible": share(int((arrived & ways).sum()), int(ways.sum())),
        "seconds": _spread(columns["ticks"][arrived] * config.step_seconds),
        "metres": _spread(metres[arrived]),
        "moves": {name: count / max(1, sum(moves.values())) for name, count in moves.items()},
        "ticks": _counts(columns["ticks"][arrived]),
        "close": _closeness(spec, columns, roads),
    }


def _counts(values: NDArray[Any]) -> list[list[int]]:
    """How often each value occurs, in their order."""
    return [
        [int(value), int(count)] for value, count in zip(*np.unique(values, return_counts=True), strict=True)
    ]


def _spread(values: NDArray[Any]) -> dict[str, Any]:
    """Mean with its 95 % interval (normal), median and 90th percentile; None where there is no value."""
    if not values.size:
        return {"count": 0, "mean": None, "low": None, "high": None, "median": None, "p90": None}
    # Summed in whole numbers of a thousandth, so that no order of summing matters.
    mean = float(np.rint(values * 1000).astype(np.int64).sum()) / 1000 / values.size
    half = Z * float(values.std(ddof=1)) / values.size**0.5 if values.size > 1 else 0.0
    return {
        "count": int(values.size),
        "mean": round(mean, 6),
        "low": round(mean - half, 6),
        "high": round(mean + half, 6),
        "median": float(np.median(values)),
        "p90": float(np.quantile(values, 0.9, method="higher")),
    }


def _closeness(spec: Evaluation, columns: Columns, roads: Columns) -> dict[str, Any]:
    """Figures of the first episodes, which were followed tick by tick."""
    count = len(columns["gap_m"])
    step_s, ticks = spec.config.step_seconds, columns["ticks"][:count].astype(int)
    arrived = (columns["outcome"][:count] == ARRIVED) & (roads["fewest"] > 0)
    lost = (ticks[arrived] - roads["fewest"][arrived].astype(int)) * step_s
    exposed = columns["exposed"].astype(int)
    return {
        "episodes": count,
        "near_misses": share(int((exposed > 0).sum()), count),
        "ttc_s": _least(columns["ttc_s"]),
        "gap_m": _least(columns["gap_m"]),
        "exposed_s": _spread(exposed * step_s),
        "changes_per_10_moves": round(10 * float(columns["changes"].sum()) / max(1, int(ticks.sum())), 4),
        "lost_s": _spread(lost),
    }


def _least(values: NDArray[Any]) -> dict[str, Any]:
    """The least value and the median of those that there are; None where there is none."""
    known = values[~np.isnan(values)]
    low, median = (float(known.min()), float(np.median(known))) if known.size else (float("nan"),) * 2
    return {
        "least": None if isnan(low) else round(low, 4),
        "median": None if isnan(median) else round(median, 4),
        "episodes": int(known.size),
    }
