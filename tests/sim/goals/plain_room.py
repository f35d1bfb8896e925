"""The room to manoeuvre with plain sets of cells, cell by cell: what `sim.goals.measure.room` must equal."""

from __future__ import annotations

from sim.oracle.lower_bounds import foreseen
from sim.state import SimState
from sim.types import MOVES


def plain_room(state: SimState, horizon: int) -> float:
    """The mean number of cells a tick from which the goal is reached by the horizon, and that are reached."""
    forecast, limit = foreseen(state)
    horizon = min(horizon, limit)
    columns = forecast.road.columns
    layers: list[set[int]] = [{forecast.ego}]
    leads: list[dict[int, set[int]]] = []
    for ahead in range(horizon):
        steps = {
            cell: {
                there.bit_length() - 1
                for there, _ in zip(forecast.steps(1 << cell, ahead), MOVES, strict=True)
                if there
            }
            for cell in layers[-1]
            if cell >= columns
        }
        leads.append(steps)
        layers.append({there for ends in steps.values() for there in ends})
    good: set[int] = {cell for cell in layers[horizon] if cell < columns}
    total = 0
    for ahead in range(horizon - 1, -1, -1):
        here = {cell for cell, ends in leads[ahead].items() if ends & good}
        total += len(here)
        good = here | {cell for cell in layers[ahead] if cell < columns}
    return total / max(1, horizon)
