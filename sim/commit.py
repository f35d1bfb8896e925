"""One tick of motion: everything at once, nothing judged."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import field_setter
from sim.rules.kinds import resting_movers, shift_boards
from sim.rules.traffic import brake
from sim.rules.traffic_cache import cached_move_movers, cached_shift_table
from sim.rules.yielding import attentive_movers, yielding_movers
from sim.types import Move
from sim.world import World

_moved = field_setter(World, "tick", "avs", "right", "left", "boards", "movers")


def commit(world: World, move: Move, config: Config) -> World:
    """Everything moved at once, nothing judged: the world one tick later.

    Raises `ValueError` where the move leads off the road.
    """
    road = world.road
    boards = world.boards
    motion = cached_move_movers(
        world.right,
        world.left,
        resting_movers(world.disabled, boards, world.episode_tick),
        boards.fixed,
        yielding_movers(world, config),
        world.driven,
        road.left_edge,
        road.right_edge,
    )
    if move is Move.STAY and motion.occupied >> world.av & 1:
        motion = brake(motion, 1 << world.av, attentive_movers(world, config))
    target = road.moved(world.av, move)
    if target is None:
        raise ValueError(f"{move} leads off the road")
    return _moved(
        world,
        world.tick + 1,
        (target, *world.avs[1:]),
        motion.right,
        motion.left,
        shift_boards(boards, motion),
        cached_shift_table(world.movers, motion),
    )
