"""Planners by name. One name, one planner: a second of the same name is refused."""

from __future__ import annotations

from typing import Protocol

from sim.config import Config
from sim.forecast import Forecast
from sim.plan import astar, dijkstra, exact, priority
from sim.plan.decision import Decision


class Planner(Protocol):
    """Anything that decides from a forecast. It must be a pure function of what it is given."""

    name: str

    def horizon(self, config: Config) -> int:
        """How many ticks of forecast it wants to read."""

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """The move, with a verdict on every move."""


_planners: dict[str, Planner] = {}


def register(planner: Planner) -> None:
    """Make a planner available by its name. Raises `ValueError` if the name is taken."""
    if planner.name in _planners:
        raise ValueError(f"there is already a planner called {planner.name!r}")
    _planners[planner.name] = planner


def planner_named(name: str) -> Planner | None:
    """The planner of that name, or None if this version has none."""
    return _planners.get(name)


for planner in (
    priority.PriorityPlanner(),
    astar.AStarPlanner(),
    dijkstra.DijkstraPlanner(),
    exact.ExactPlanner(),
):
    register(planner)
