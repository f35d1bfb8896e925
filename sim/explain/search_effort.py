"""How many states a search of A* looks at for one decision, searched anew and state by state."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import sense
from sim.forecast import predict
from sim.search.astar import AdaptiveHeuristic, cheapest
from sim.search.costs import weights
from sim.search.reachability import least_ticks_by_move, steps_left
from sim.search.time_expanded import TimeExpandedGraph
from sim.state import SimState


@dataclass(frozen=True, slots=True)
class SearchEffort:
    """The search for the decision of one state."""

    expanded: int
    """states (column, row, tick) whose steps were looked at, over one search for each free move"""
    searches: int
    """free moves from which a way leads to the goal"""


def search_effort(state: SimState) -> SearchEffort:
    """The effort of A* for the first ego's decision in a state; the episode must be running."""
    percept, config = sense(state)[0], state.config_of(None)
    limit = steps_left(config, percept.episode_tick)
    forecast = predict(percept, config.max_ticks + 1)
    terrain = TimeExpandedGraph(forecast, weights(config), limit)
    lessons, expanded, searches = AdaptiveHeuristic(), 0, 0
    ticks = least_ticks_by_move(forecast, limit)
    for move, there, _cost in terrain.steps(terrain.start):
        if ticks[move] is None:
            continue  # no way leads on: the planner searches none either
        way = cheapest(terrain, there, lessons=lessons)
        if way is not None:
            expanded, searches = expanded + way.expanded, searches + 1
    return SearchEffort(expanded, searches)
