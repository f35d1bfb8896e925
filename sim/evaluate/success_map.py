"""Success maps: how often a planner arrives, over the numbers of two kinds of things.

A map is an evaluation whose cases are the cells of a grid; every planner drives the same seeds in each. What
it says of a region holds where the intervals of all its cells say so.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, Final

from sim.config import COUNTS, Config, Problem
from sim.evaluate.cases import Case

AXES: Final = tuple(COUNTS.values())
"""What a map may be drawn over: numbers of things."""
LEVELS: Final = 6
"""Values of an axis where none are given, none of the things first."""
MAX_LEVELS: Final = 12
"""Most values of an axis."""
MAX_CELLS: Final = MAX_LEVELS * MAX_LEVELS
_FULLEST: Final = {"potholes": 0.22, "vehicles": 0.22}
"""Share of a road's cells that the last value of an axis takes, about; `_FULLEST_OTHER` of other things."""
_FULLEST_OTHER: Final = 0.11
LIMITS: Final = (0.95, 0.9, 0.8, 0.5)
"""Shares of arrivals for which a region is looked for; the first that has one is told."""

Axes = tuple[str, str]
"""What lies along the rows of the table and what along its columns."""


def problems_of_map(axes: Sequence[str], vary: Mapping[str, Sequence[Any]]) -> tuple[Problem, ...]:
    """Why there is no map over these axes with these values."""
    if len(axes) != 2 or len(set(axes)) != 2 or any(name not in AXES for name in axes):
        return (Problem("map", "must_be_a_list_of", choices=AXES),)
    if any(name not in axes for name in vary):
        return (Problem("vary", "must_be_a_list_of", choices=tuple(axes)),)
    counts = [len(set(vary[name])) for name in axes if name in vary]
    if not all(2 <= count <= MAX_LEVELS for count in counts):
        return (Problem("levels", "must_be_between", low=2, high=MAX_LEVELS),)
    return ()


def cells_of(axes: Axes, vary: Mapping[str, Sequence[Any]], config: Config) -> tuple[Case, ...]:
    """A case for each cell: row by row, upwards. Axes without values of their own get `LEVELS` of them."""
    rows, columns = (sorted(set(vary.get(name) or _levels(name, config))) for name in axes)
    return tuple(
        Case(said, said) for said in (dict(zip(axes, each, strict=True)) for each in product(rows, columns))
    )


def _levels(name: str, config: Config) -> list[int]:
    """Round numbers from none to about as many as make the road hard."""
    cells = config.columns * (config.rows - 2)
    most = cells * _FULLEST.get(name, _FULLEST_OTHER) / (LEVELS - 1)
    steps = [digit * 10**power for power in range(6) for digit in (1, 2, 5)]
    step = min(steps, key=lambda each: abs(each - most))
    return [step * place for place in range(LEVELS)]


def is_grid(axes: Axes, cases: Sequence[Case]) -> bool:
    """Whether the cases are the cells of a map over these axes, in their order."""
    if any(tuple(case.said) != axes for case in cases):
        return False
    rows, columns = (sorted({case.said[name] for case in cases}) for name in axes)
    return [tuple(case.said.values()) for case in cases] == list(product(rows, columns))


def success_map(axes: Axes, planners: Sequence[str], cases: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The map as JSON values. `cases`: the summary of each cell, in their order.

    Of each planner: the cells row by row, each with its share of arrivals and the number of its case; and the
    largest region in which it certainly arrives that often.
    """
    values = [sorted({case["said"][name] for case in cases}) for name in axes]
    width = len(values[1])
    maps = {}
    for planner in planners:
        cells = [
            {**case["planners"][planner]["arrived"], "case": number} for number, case in enumerate(cases)
        ]
        rows = [cells[first : first + width] for first in range(0, len(cells), width)]
        maps[planner] = {"cells": rows, "region": _region(rows)}
    return {"axes": list(axes), "values": values, "planners": maps}


def _region(rows: Sequence[Sequence[Mapping[str, Any]]]) -> dict[str, Any] | None:
    """The largest region from the first cell on of which every cell arrives more often than a limit.

    It says how many rows and columns it has; None where not even the first cell is above the last limit.
    """
    for limit in LIMITS:
        width, best = len(rows[0]), (0, 0, 0)
        for height, row in enumerate(rows, 1):
            above = next((place for place, cell in enumerate(row) if cell["low"] <= limit), len(row))
            width = min(width, above)
            best = max(best, (height * width, height, width))
        if best[0]:
            return {"above": limit, "rows": best[1], "columns": best[2]}
    return None
