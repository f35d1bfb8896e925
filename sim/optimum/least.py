"""The least ticks and the least cost from a moment to the goal, as the rules and the charges say.

Exact where movers do not react to the vehicle; with courtesy above 0 the first tick is exact and later
ones assume that nobody gives way.
"""

from __future__ import annotations

from sim.forecast import Forecast, foretell
from sim.kinds import Outcome
from sim.perceive import perceive
from sim.plan.costs import weights
from sim.run import Run
from sim.search.astar import cheapest
from sim.search.reach import reach, steps_left
from sim.search.spacetime import SpaceTime


def foreseen(run: Run) -> tuple[Forecast, int]:
    """The forecast to the episode's end, and the steps left. Raises `ValueError` after the end."""
    if run.world.outcome is not Outcome.RUNNING:
        raise ValueError("the episode has ended")
    limit = steps_left(run.config, run.world.episode_tick)
    return foretell(perceive(run.world, run.config), max(1, limit)), limit


def least_ticks(run: Run) -> int | None:
    """Ticks of the quickest way from here to row 0 that meets nothing; None: there is no way in time."""
    if run.world.outcome is Outcome.SUCCESS:
        return 0
    if run.world.outcome is not Outcome.RUNNING:
        return None
    forecast, limit = foreseen(run)
    return reach(forecast, 1 << forecast.ego, limit).ticks


def least_cost(run: Run) -> int | None:
    """The cheapest way from here to row 0 by the configuration's charges; None: there is no way in time."""
    if run.world.outcome is Outcome.SUCCESS:
        return 0
    if least_ticks(run) is None:
        return None
    forecast, limit = foreseen(run)
    terrain = SpaceTime(forecast, weights(run.config), limit)
    way = cheapest(terrain, terrain.start)
    return None if way is None else way.cost
