"""One tick of the world: everything moves at once, then it is judged."""

from __future__ import annotations

from dataclasses import replace

from sim.commit import commit
from sim.config import Config
from sim.judge import collisions, outcome
from sim.types import Move, Outcome
from sim.world import World


def transition(world: World, move: Move, config: Config) -> World:
    """The world one tick later, with the outcome, its tick and the cause of a crash set.

    Raises `ValueError` where the move leads off the road.
    """
    after = commit(world, move, config)
    crashes = collisions(world, after, config.ego_dynamics(world.road))
    result = outcome(after, crashes, config.max_ticks)
    if result is Outcome.RUNNING:
        return after
    return replace(after, outcome=result, ended=after.tick, cause=crashes[0] if crashes else None)
