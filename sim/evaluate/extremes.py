"""The episodes behind a planner's figures, beside its failures: the slowest arrival, the nearest miss."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.evaluate.rows import ARRIVED, ROADS, Rows
from sim.evaluate.spec import Evaluation


def extremes(spec: Evaluation, planner: str, rows: Rows) -> dict[int, tuple[str, ...]]:
    """For each episode the figures that it stands behind.

    `arrived`: the arrival of middle length; `slowest`; `ttc`, `gap`: where something came nearest; `exposed`,
    `changes`, `lost`: where there was most of it; `only_first`: this planner failed and the first one
    arrived; `only_PLANNER`: this planner, the first, failed and that one arrived.
    """
    found: dict[int, list[str]] = {}
    columns = rows[planner]
    arrived = np.flatnonzero(columns["outcome"] == ARRIVED)
    if arrived.size:
        order = arrived[np.argsort(columns["ticks"][arrived], kind="stable")]
        found.setdefault(int(order[(order.size - 1) // 2]), []).append("arrived")
        longest = columns["ticks"][arrived].max()
        slowest = arrived[columns["ticks"][arrived] == longest][0]
        found.setdefault(int(slowest), []).append("slowest")
    # Of a cell of a success map only how it ended is told, so nothing else has an episode behind it.
    others = (*_closest(rows, planner), *_disagreements(spec, planner, rows)) if spec.axes is None else ()
    for name, index in others:
        found.setdefault(index, []).append(name)
    return {index: tuple(names) for index, names in found.items()}


def _closest(rows: Rows, planner: str) -> list[tuple[str, int]]:
    """Of the episodes that were followed closely."""
    columns = rows[planner]
    count = len(columns["gap_m"])
    found = []
    for name, column in (("ttc", "ttc_s"), ("gap", "gap_m")):
        if not np.isnan(columns[column]).all():
            found.append((name, int(np.nanargmin(columns[column]))))
    found += [(name, int(columns[name].argmax())) for name in ("exposed", "changes") if columns[name].any()]
    known = (columns["outcome"][:count] == ARRIVED) & (rows[ROADS]["fewest"] > 0)
    lost = np.where(known, columns["ticks"][:count].astype(int) - rows[ROADS]["fewest"], 0)
    if lost.any():
        found.append(("lost", int(lost.argmax())))
    return found


def _disagreements(spec: Evaluation, planner: str, rows: Rows) -> list[tuple[str, int]]:
    def arrived(name: str) -> NDArray[Any]:
        return np.asarray(rows[name]["outcome"] == ARRIVED)

    first = spec.planners[0]
    others = [(f"only_{name}", name) for name in spec.planners[1:]]
    pairs = others if planner == first else [("only_first", first)]
    found = []
    for name, other in pairs:
        where = np.flatnonzero(arrived(other) & ~arrived(planner))
        if where.size:
            found.append((name, int(where[0])))
    return found
