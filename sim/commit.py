"""One tick of motion: everything at once, nothing judged."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import field_setter
from sim.rules.dynamics import Dynamics
from sim.rules.mover_boards import shift_boards
from sim.rules.slipping import moves_made
from sim.rules.traffic_cache import cached_reactions, cached_shift_table, cached_step
from sim.types import Move
from sim.world import World
from sim.world.grid import Board

_moved = field_setter(World, "tick", "avs", "right", "left", "boards", "movers")


def commit(world: World, moves: tuple[Move, ...], config: Config) -> World:
    """Everything moved at once, nothing judged: the world one tick later.

    `moves` are in the order of `World.avs`. Where there are several egos, one in row 0 has arrived and stays.
    On snow a move may slip. Raises `ValueError` where a move leads off the road, and where there are not as
    many as egos.
    """
    if config.slips:
        moves = moves_made(world, moves, config)
    behaviour, road, boards = config.mover_behaviour, world.road, world.boards
    right, left, reactions = world.right, world.left, cached_reactions(world, config)
    motion = cached_step(
        behaviour,
        right,
        left,
        boards.marked,
        (right | left) & boards.holding,
        boards.fixed,
        road.left_edge,
        road.right_edge,
        world.tick - world.episode_start,
        world.driven,
        reactions,
    )
    avs, dynamics = world.avs, config.ego_dynamics(road)
    if len(avs) == 1:
        (cell,), (move,) = avs, moves
        target = dynamics.target(cell, move)
        if target is None:
            raise ValueError(f"{move} leads off the road")
        targets: tuple[int, ...] = (target,)
        standing = 1 << cell if move is Move.STAY else 0
    else:
        targets, standing = _several(world, moves, dynamics)
    if standing and motion.occupied & standing:
        motion = behaviour.brake(motion, standing, reactions)
    return _moved(
        world,
        world.tick + 1,
        targets,
        motion.right,
        motion.left,
        shift_boards(boards, motion) if boards.others else boards,
        cached_shift_table(world.movers, motion),
    )


def moves_with(world: World, move: Move, number: int = 0) -> tuple[Move, ...]:
    """The moves in the order of `World.avs` where one ego makes this move and all others stay."""
    if len(world.avs) == 1:
        return (move,)
    return tuple(move if each == number else Move.STAY for each in range(len(world.avs)))


def _several(world: World, moves: tuple[Move, ...], dynamics: Dynamics) -> tuple[tuple[int, ...], Board]:
    """Where several egos go, and the cells of those that stay."""
    targets, standing = [], 0
    for cell, move in zip(world.avs, moves, strict=True):
        target = cell if cell < world.road.columns else dynamics.target(cell, move)
        if target is None:
            raise ValueError(f"{move} leads off the road")
        targets.append(target)
        if target == cell:
            standing |= 1 << cell
    return tuple(targets), standing
