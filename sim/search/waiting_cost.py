"""What it costs to stay where a mover brakes for the ego.

The mover then goes on from another cell than the forecast of every other move has it in, so the way on is
searched in the forecast of a vehicle that stands (`Forecast.standing`).
"""

from __future__ import annotations

from sim.forecast import Forecast
from sim.search.astar import cheapest
from sim.search.costs import Weights
from sim.search.reachability import reachability
from sim.search.time_expanded import TimeExpandedGraph
from sim.types import MOVES, Move

_STAY = MOVES.index(Move.STAY)


def cost_of_staying(forecast: Forecast, weights: Weights, limit: int) -> int | None:
    """The cost of staying now and the cheapest way on; None where no mover brakes, or no way leads on."""
    standing = forecast.standing
    if standing is None:
        return None
    start = 1 << forecast.ego
    if reachability(standing, start, limit - 1, after=1, whole=False).ticks is None:
        return None  # a heuristic search would try everything before it gave up
    terrain = TimeExpandedGraph(standing, weights, limit)
    for move, there, cost in terrain.steps(terrain.start):
        if move == _STAY:
            way = cheapest(terrain, there)
            return None if way is None else cost + way.cost
    return None
