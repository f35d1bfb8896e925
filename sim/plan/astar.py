"""`astar`: the cheapest way to the goal, searched ahead in (column, row, tick).

Structure: one A* for each move that is free now, from the cell it leads to; what one search shows of
the way to the goal sharpens the bounds of the next, so that most of them end where an earlier way is
met. Guarantees: every move's total cost is exact, and the move taken is a cheapest (ties in the order
of `Move`); since every tick costs something and the forecast holds, the cost to go falls by what is paid,
so that there is no livelock; a road that can be driven without others braking for it is driven. Where the
compiled costs are loaded (`sim.search.compiled_costs`), the same totals come from them. Simplifications:
the forecast assumes that nobody brakes for the ego or gives way after the coming tick, so a way that
depends on it is not found; smoothness is charged per move.
Sources: Hart, Nilsson & Raphael (1968); space-time: Silver, "Cooperative pathfinding" (2005);
Koenig & Likhachev, "Adaptive A*" (2005).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from sim.config import Config
from sim.forecast import Forecast
from sim.plan.by_cost import decide_by_cost
from sim.plan.decision import Decision, Measure
from sim.plan.protocol import Traits
from sim.search.astar import AdaptiveHeuristic, cheapest
from sim.search.compiled_costs import compiled_costs
from sim.search.continued import Known, continued, keep
from sim.search.costs import Weights, weights
from sim.search.graph import State
from sim.search.reachability import least_ticks_by_move, steps_left
from sim.search.time_expanded import TimeExpandedGraph
from sim.search.waiting_cost import cost_of_staying
from sim.types import MOVES, Move

STAY = MOVES.index(Move.STAY)
SEARCHED: Final = "searched"
"""The kind of search under which lessons are kept."""


def _begun(
    forecast: Forecast, charges: Weights, limit: int
) -> tuple[TimeExpandedGraph, AdaptiveHeuristic, State]:
    """The terrain, what is known of it from earlier decisions on the same road, and where to begin in it."""
    found = continued(SEARCHED, forecast, charges, limit)
    if found is not None:
        known, ahead = found
        terrain, lessons = known.found
        return terrain, lessons, ahead * forecast.road.columns * forecast.road.rows + forecast.ego
    terrain, lessons = TimeExpandedGraph(forecast, charges, limit), AdaptiveHeuristic()
    if not forecast.egos:
        keep(SEARCHED, Known(forecast, charges, limit, (terrain, lessons)))
    return terrain, lessons, terrain.start


class AStarPlanner:
    """The first move of a cheapest way to the goal."""

    name = "astar"
    traits = Traits(forward_only=True, weighs_costs=True, decisions_per_answer=240)

    def horizon(self, config: Config) -> int:
        """To the end of the episode; ticks are only foretold as far as the search gets."""
        return config.max_ticks + 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """The move, and what each of the six costs in all."""
        limit, charges = steps_left(config, forecast.episode_tick), weights(config)
        found = compiled_costs(forecast.percept, charges, limit)
        if found is not None:
            return decide_by_cost(self.name, Measure.COST, forecast, found.totals, limit, found.lasting)
        return decide_by_cost(self.name, Measure.COST, forecast, searched(forecast, charges, limit), limit)


def searched(forecast: Forecast, charges: Weights, limit: int) -> list[int | None]:
    """What every move costs in all with `limit` ticks left, in the order of `Move`; None: no way."""
    terrain, lessons, start = _begun(forecast, charges, limit)
    totals: list[int | None] = [None] * len(MOVES)
    ticks: Sequence[int | None] | None = None
    for move, there, cost in terrain.steps(start):
        if there in lessons.exact:
            totals[move] = cost + lessons.exact[there]
            continue
        if ticks is None:
            ticks = least_ticks_by_move(forecast, limit)
        if ticks[move] is None:
            continue  # a heuristic search would try everything before it gave up
        way = cheapest(terrain, there, lessons=lessons)
        if way is not None:
            totals[move] = cost + way.cost
    if totals[STAY] is None:
        totals[STAY] = cost_of_staying(forecast, charges, limit)
    return totals
