"""One tick of motion: everything at once, nothing judged."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import field_setter
from sim.rules.traffic import shift_board
from sim.rules.traffic_cache import cached_reactions, cached_shift_table, cached_step
from sim.types import Move
from sim.world import World

_moved = field_setter(World, "tick", "avs", "right", "left", "pedestrians", "movers")


def commit(world: World, move: Move, config: Config) -> World:
    """Everything moved at once, nothing judged: the world one tick later.

    Raises `ValueError` where the move leads off the road.
    """
    behaviour, road = config.mover_behaviour, world.road
    reactions = cached_reactions(world, config)
    motion = cached_step(
        behaviour,
        world.right,
        world.left,
        world.pedestrians,
        world.disabled,
        world.fixed,
        road.left_edge,
        road.right_edge,
        world.episode_tick,
        world.driven,
        reactions,
    )
    if move is Move.STAY and motion.occupied >> world.av & 1:
        motion = behaviour.brake(motion, 1 << world.av, reactions)
    target = config.ego_dynamics(road).target(world.av, move)
    if target is None:
        raise ValueError(f"{move} leads off the road")
    return _moved(
        world,
        world.tick + 1,
        (target, *world.avs[1:]),
        motion.right,
        motion.left,
        shift_board(world.pedestrians, motion) if world.pedestrians else 0,
        cached_shift_table(world.movers, motion),
    )
