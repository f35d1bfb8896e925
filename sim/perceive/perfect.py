"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from sim.config import Config
from sim.courtesy import yielding
from sim.kinds import Kind
from sim.perceive.percept import Percept
from sim.world import World


def perceive(world: World, config: Config, av: int = 0) -> Percept:
    """What autonomous vehicle number `av` (from 0) sees of the world."""
    return Percept(
        road=world.road,
        tick=world.tick,
        episode_tick=world.episode_tick,
        ego=world.avs[av],
        ego_id=f"{Kind.AV}-{av + 1}",
        potholes=world.potholes,
        barriers=world.barriers,
        right=world.right,
        left=world.left,
        pedestrians=world.pedestrians,
        yielding=yielding(world, config),
        vehicles=world.board(Kind.AV),
        movers=world.movers,
        hazards=world.hazards,
    )
