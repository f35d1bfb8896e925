"""The summary of an evaluation under several conditions: all together, each alone, and what they do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from sim.evaluate.compare import compare
from sim.evaluate.rows import ROADS, Columns, Rows
from sim.evaluate.spec import Evaluation
from sim.evaluate.success_map import success_map
from sim.evaluate.summary import summarize


def summarize_cases(
    spec: Evaluation, cases: Sequence[Rows], cancelled: Callable[[], bool] = lambda: False
) -> dict[str, Any]:
    """All figures as JSON values: those of all episodes, with `cases` and `effects` beside them."""
    alone = [summarize(spec.under(number), rows, cancelled) for number, rows in enumerate(cases)]
    together = summarize(replace(spec, episodes=spec.total, cases=()), _together(spec, cases), look=False)
    # Runs of the same seed under two conditions are no two pairs, so planners are compared under each alone.
    together["comparisons"] = []
    together["alike"] = alone[0]["alike"]
    together["examples"] = [
        {**example, "case": number} for number, each in enumerate(alone) for example in each.pop("examples")
    ]
    together["cases"] = [
        {"said": dict(case.said), **summary} for case, summary in zip(spec.cases, alone, strict=True)
    ]
    if spec.axes is not None:
        # Each cell compared with the empty road would be many sentences; the map says it.
        return together | {"effects": [], "map": success_map(spec.axes, spec.planners, together["cases"])}
    together["effects"] = [
        {**_effect(spec, planner, cases, number), "planner": planner, "case": number}
        for planner in spec.planners
        for number in range(1, len(cases))
    ]
    return together


def _effect(spec: Evaluation, planner: str, cases: Sequence[Rows], number: int) -> dict[str, Any]:
    """How a planner fares under a condition compared with the first one, seed by seed."""
    both = {"here": cases[number][planner], "first": cases[0][planner]}
    found = compare(spec.under(number), ("here", "first"), both)
    return {name: value for name, value in found.items() if name not in ("first", "second")}


def _together(spec: Evaluation, cases: Sequence[Rows]) -> Rows:
    """The columns of all cases, those episodes first that were followed closely."""
    return {
        of: {name: _column(cases, of, name, spec.detailed) for name in cases[0][of]}
        for of in (*_planners(cases[0]), ROADS)
    }


def _planners(rows: Rows) -> list[str]:
    return [name for name in rows if name != ROADS]


def _column(cases: Sequence[Rows], of: str, name: str, close: int) -> Any:
    columns: list[Columns] = [rows[of] for rows in cases]
    near = [each[name][:close] for each in columns]
    far = [each[name][close:] for each in columns]
    return np.concatenate([*near, *far])
