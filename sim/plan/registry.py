"""Planners by name: those built in, those a program registers, those other packages bring (entry points)."""

from __future__ import annotations

from sim import planner_names
from sim.plan import astar, bfs, dijkstra, priority, rule_based
from sim.plan.protocol import UNKNOWN, Planner, Traits

_planners: dict[str, Planner] = {}
_traits: dict[str, Traits] = {}


def register(planner: Planner) -> None:
    """Make a planner of this program available by its name, with the traits of its class.

    It is called as it is; one that is not trusted belongs in a package of its own (`sim.plan.safe_planning`).
    Raises `ValueError` if the name is taken, and for a planner that is not deterministic.
    """
    traits = getattr(planner, "traits", UNKNOWN)
    if not traits.deterministic:
        raise ValueError(
            f"the planner {planner.name!r} is not deterministic: bring it in a package, where its decisions "
            "are recorded (sim/plan/README.md)"
        )
    planner_names.claim(planner.name)
    _planners[planner.name] = planner
    _traits[planner.name] = traits


def planner_named(name: str) -> Planner | None:
    """The planner of that name that is called directly, or None if there is none."""
    return _planners.get(name)


def traits_of(name: str) -> Traits:
    """The traits of the planner of that name; of another package's, those of which nothing is known."""
    return _traits.get(name, UNKNOWN)


for planner in (
    priority.PriorityPlanner(),
    rule_based.RulesPlanner(),
    astar.AStarPlanner(),
    dijkstra.DijkstraPlanner(),
    bfs.BfsPlanner(),
):
    register(planner)
for old, name in planner_names.ALIASES.items():
    _planners[old], _traits[old] = _planners[name], _traits[name]
