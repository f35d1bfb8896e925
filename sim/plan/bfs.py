"""`bfs`: the fewest ticks to the goal, whatever else they cost.

Structure: sets of cells stepped by the rules, once for each move that is free now. Guarantees: every
move's ticks are exact; no livelock; a road that can be driven without others braking for it is driven.
Simplifications and compiled costs: as `astar`, but nearness does not count.
Source: `sim.search.reachability`.
"""

from __future__ import annotations

from sim.config import Config
from sim.forecast import Forecast
from sim.plan.by_cost import decide_by_cost
from sim.plan.decision import Decision, Measure
from sim.plan.protocol import Traits
from sim.search.compiled_costs import compiled_costs
from sim.search.costs import TICKS_ALONE
from sim.search.reachability import least_ticks_by_move, steps_left


class BfsPlanner:
    """The first move of a way of fewest ticks."""

    name = "bfs"
    traits = Traits(forward_only=True, decisions_per_answer=450)

    def horizon(self, config: Config) -> int:
        """To the end of the episode; ticks are only foretold as far as the sets get."""
        return config.max_ticks + 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """The move, and the ticks each of the six leads to the goal in."""
        limit = steps_left(config, forecast.episode_tick)
        found = compiled_costs(forecast.percept, TICKS_ALONE, limit)
        if found is not None:
            return decide_by_cost(self.name, Measure.TICKS, forecast, found.totals, limit, found.lasting)
        return decide_by_cost(self.name, Measure.TICKS, forecast, least_ticks_by_move(forecast, limit), limit)
