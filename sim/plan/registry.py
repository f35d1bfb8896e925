"""Planners by name: those built in, those a program registers, those other packages bring (entry points)."""

from __future__ import annotations

from typing import Protocol

from sim import planner_names
from sim.config import Config
from sim.forecast import Forecast
from sim.plan import astar, bfs, dijkstra, priority, rule_based
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
    """Make a planner of this program available by its name. Raises `ValueError` if the name is taken.

    It is called as it is; one that is not trusted belongs in a package of its own (`sim.plan.safe_planning`).
    """
    planner_names.claim(planner.name)
    _planners[planner.name] = planner


def planner_named(name: str) -> Planner | None:
    """The planner of that name that is called directly, or None if there is none."""
    return _planners.get(name)


for planner in (
    priority.PriorityPlanner(),
    rule_based.RulesPlanner(),
    astar.AStarPlanner(),
    dijkstra.DijkstraPlanner(),
    bfs.BfsPlanner(),
):
    register(planner)
