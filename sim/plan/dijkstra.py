"""`dijkstra`: the cost to the goal from every state at once, backwards, without a heuristic.

Structure: a bound on how far ahead a cheapest way can lie, then one sweep backwards through the ticks.
Guarantees: as `astar`, whose totals and moves it shares exactly, found another way. It takes about as
long on an empty road as on a crowded one. Compiled costs and simplifications: as `astar`.
Source: Dijkstra, "A note on two problems in connexion with graphs" (1959), whose order of settling is
here given by time.
"""

from __future__ import annotations

from sim.config import Config
from sim.forecast import Forecast
from sim.plan.by_cost import decide_by_cost
from sim.plan.decision import Decision, Measure
from sim.plan.protocol import Traits
from sim.search.compiled_costs import compiled_costs
from sim.search.costs import weights
from sim.search.reachability import steps_left


class DijkstraPlanner:
    """The first move of a cheapest way to the goal."""

    name = "dijkstra"
    traits = Traits(forward_only=True, weighs_costs=True, decisions_per_answer=240)

    def horizon(self, config: Config) -> int:
        """To the end of the episode; ticks are only foretold as far as the sweep begins."""
        return config.max_ticks + 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """The move, and what each of the six costs in all."""
        from sim.search.backward_dp import totals_by_move

        limit, charges = steps_left(config, forecast.episode_tick), weights(config)
        found = compiled_costs(forecast.percept, charges, limit)
        if found is not None:
            return decide_by_cost(self.name, Measure.COST, forecast, found.totals, limit, found.lasting)
        totals = totals_by_move(forecast, charges, limit)
        return decide_by_cost(self.name, Measure.COST, forecast, totals, limit)
