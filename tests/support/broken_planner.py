"""A planner with one deliberate defect, for what is to find such: it goes blind in crowds."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from sim.config import Config
from sim.forecast import Forecast
from sim.plan import Decision
from sim.plan.astar import AStarPlanner
from sim.plan.registry import planner_named, register
from sim.types import Move

NAME: Final = "blind-in-crowds"
NEAR_ROWS: Final = 4
CROWD: Final = 14
"""Things in the rows ahead from which it goes blind; a default road seldom has as many."""


class BlindInCrowds(AStarPlanner):
    """A*, but with `CROWD` things in the next `NEAR_ROWS` rows it goes straight on, whatever is there."""

    name = NAME

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """See `Planner.decide`."""
        taken = super().decide(forecast, config)
        columns, percept = forecast.road.columns, forecast.percept
        row = forecast.ego // columns
        ahead = range(max(0, row - NEAR_ROWS) * columns, row * columns)
        crowd = sum(cell in ahead for cell in (*percept.movers, *percept.hazards))
        return replace(taken, move=Move.FORWARD) if crowd >= CROWD else taken


def registered() -> str:
    """Its name, once it is known."""
    if planner_named(NAME) is None:
        register(BlindInCrowds())
    return NAME
