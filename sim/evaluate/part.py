"""Runs a stretch of an evaluation's episodes, in this process: the work that executors hand out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from sim.evaluate.closeness import Closeness
from sim.evaluate.executor import CancelledError
from sim.evaluate.rows import ARRIVED, NO_WAY, ROADS, UNKNOWN, WAY, Columns, Rows
from sim.evaluate.spec import STATES, Evaluation, Part
from sim.oracle.lower_bounds import can_arrive, least_ticks
from sim.search.reactive import ImpatientError
from sim.session.triggers import fire
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

OUTCOMES: Final = tuple(Outcome)
_WHOLE: Final = ("ticks", "forward", "sideways", "diagonal", "stay")
_CLOSE: Final = {"gap_m": np.float32, "ttc_s": np.float32, "exposed": np.uint16, "changes": np.uint16}


def run_part(spec: Evaluation, part: Part, cancelled: Callable[[], bool] = lambda: False) -> Rows:
    """The figures of a part's episodes, by planner, and of its roads.

    Raises `CancelledError` soon after `cancelled()` is true, and `GenerationError` where a road must be
    drivable and none is found.
    """
    if spec.cases:
        number, first = divmod(part.first, spec.episodes)
        return run_part(spec.under(number), Part(first, part.count), cancelled)
    close = part.first < spec.detailed
    rows: Rows = {}
    for planner in spec.planners:
        if cancelled():
            raise CancelledError
        if not close and spec.compiled(planner):
            from sim.evaluate.compiled import drive

            rows[planner] = drive(spec, planner, part)
        else:
            rows[planner] = _one_by_one(spec, planner, part, close, cancelled)
    rows[ROADS] = _roads(spec, part, rows, close, cancelled)
    return rows


def _one_by_one(
    spec: Evaluation, planner: str, part: Part, close: bool, cancelled: Callable[[], bool]
) -> Columns:
    episodes = []
    for index in range(part.first, part.first + part.count):
        if cancelled():
            raise CancelledError
        episodes.append(drive_one(spec.start(index, planner), Closeness() if close else None))
    kinds: dict[str, Any] = {"outcome": np.uint8, **dict.fromkeys(_WHOLE, np.uint16)} | (
        _CLOSE if close else {}
    )
    return {name: np.array([each[name] for each in episodes], kind) for name, kind in kinds.items()}


def drive_one(state: SimState, closeness: Closeness | None = None) -> dict[str, float]:
    """Drives an episode to its end and returns its figures (`sim.evaluate.rows`)."""
    ticks = 0
    before = state.metrics
    while state.world.outcome is Outcome.RUNNING:
        done, earlier = step(state), state
        if closeness is not None:
            closeness.add(state, done.state, None if done.decision is None else done.decision.move)
        state = with_rules(earlier, done.state)
        ticks += 1
    metrics = state.metrics
    return {
        "outcome": OUTCOMES.index(state.world.outcome),
        "ticks": ticks,
        "forward": metrics.forward - before.forward,
        "sideways": metrics.lateral - before.lateral,
        "diagonal": metrics.diagonal - before.diagonal,
        "stay": metrics.stay - before.stay,
    } | ({} if closeness is None else closeness.values())


def with_rules(before: SimState, after: SimState) -> SimState:
    """The state after a tick with the rules that were due done; none is once the episode is over."""
    if not after.triggers or after.world.outcome is not Outcome.RUNNING:
        return after
    return fire(before, after)[0]


def _roads(spec: Evaluation, part: Part, rows: Rows, close: bool, cancelled: Callable[[], bool]) -> Columns:
    """Which roads can be driven: one on which a planner arrived can; the others are searched."""
    arrived = np.zeros(part.count, bool)
    for planner in spec.planners:
        arrived |= rows[planner]["outcome"] == ARRIVED
    solvable = np.where(arrived, WAY, UNKNOWN).astype(np.uint8)
    fewest = np.zeros(part.count if close else 0, np.uint16)
    if not close and spec.compiled(spec.planners[0]) and spec.config.certain:
        from sim.evaluate.compiled import ways

        # A way that is found is one; only where none is are the reactions of movers searched as well.
        places = np.flatnonzero(~arrived)
        found = places[ways(spec, places + part.first)]
        solvable[found], arrived[found] = WAY, True
    for place in range(part.count) if close else np.flatnonzero(~arrived).tolist():
        if cancelled():
            raise CancelledError
        if spec.rules:
            continue  # what they do to the road is no part of a proof
        start = spec.start(part.first + place, spec.planners[0])
        try:
            if close:
                ticks = least_ticks(start, STATES)
                fewest[place] = ticks or 0
                way = ticks is not None
            else:
                way = can_arrive(start, STATES)
        except ImpatientError:
            continue
        solvable[place] = WAY if way else NO_WAY
    columns = {"solvable": solvable}
    return columns | {"fewest": fewest} if close else columns
