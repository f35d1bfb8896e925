"""One tick of motion: everything at once, nothing judged."""

from __future__ import annotations

from sim.changing import changer
from sim.config import Config
from sim.courtesy import attentive, yielding
from sim.kinds import Move
from sim.moving import followed_table_once, move_movers_once
from sim.rules import brake, followed_board, pedestrians_walk
from sim.world import World

_moved = changer(World, "tick", "avs", "right", "left", "pedestrians", "movers")


def commit(world: World, move: Move, config: Config) -> World:
    """Everything moved at once, nothing judged: the world one tick later.

    Raises `ValueError` where the move leads off the road.
    """
    road = world.road
    disabled = world.disabled
    resting = disabled if pedestrians_walk(world.episode_tick) else disabled | world.pedestrians
    motion = move_movers_once(
        world.right,
        world.left,
        resting,
        world.fixed,
        yielding(world, config),
        world.driven,
        road.left_edge,
        road.right_edge,
    )
    if move is Move.STAY and config.attentive:
        motion = brake(motion, 1 << world.av, attentive(world, config))
    target = road.moved(world.av, move)
    if target is None:
        raise ValueError(f"{move} leads off the road")
    return _moved(
        world,
        world.tick + 1,
        (target, *world.avs[1:]),
        motion.right,
        motion.left,
        followed_board(world.pedestrians, motion) if world.pedestrians else 0,
        followed_table_once(world.movers, motion),
    )
