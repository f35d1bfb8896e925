"""Whether an episode is sure to end stuck, proved without driving on.

A planner that looks to the goal and finds no way makes the move after which it keeps clear longest. Where the
goal is out of reach whoever reacts, and a way keeps clear to the end of the episode, it stands or moves about
until time is up: at every tick there is such a move again, since a way that meets nothing stays one.
"""

from __future__ import annotations

from sim.explain.episode_rollout import decided
from sim.forecast import Forecast
from sim.perceive import sensor_named
from sim.plan import Measure
from sim.search.dead_ends import cells_that_may_arrive
from sim.search.reachability import steps_left
from sim.state import SimState, StepResult
from sim.types import Mode, Outcome


def shut_off(tick: StepResult, ego: str | None = None) -> bool:
    """Whether a planner that looks to the goal found no way in this tick."""
    decision = decided(tick, ego)
    return (
        decision is not None
        and decision.asked is None
        and decision.fault is None
        and decision.measure in (Measure.COST, Measure.TICKS)
        and decision.chosen.cost is None
    )


def is_stuck(state: SimState) -> bool:
    """Whether the only ego of a road, whose planner found no way in the tick before, ends stuck for certain.

    False also where that is not proved.
    """
    world, config = state.world, state.config
    if (
        len(world.avs) > 1
        or world.outcome is not Outcome.RUNNING
        or not (config.certain and config.free_ways_hold and sensor_named(config.sensor).faithful)
        or state.ego().mode is Mode.MANUAL
        or state.ego().queue
    ):
        return False
    limit = steps_left(config, world.episode_tick)
    if limit < 1:
        return False
    forecast = Forecast.of_truth(world, config, limit)
    if cells_that_may_arrive(forecast, limit)[0] >> world.av & 1:
        return False
    *_, last = forecast.spreads(1 << world.av, 0, limit)
    return last != 0
