"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.percept import Percept
from sim.rules.yielding import attentive_movers, yielding_movers
from sim.types import Kind
from sim.world import World

_seen = fast_constructor(
    Percept,
    "road",
    "tick",
    "episode_tick",
    "ego",
    "ego_id",
    "right",
    "left",
    "boards",
    "yielding",
    "attentive",
    "vehicles",
    "swept",
    "movers",
    "hazards",
)


def perceive(world: World, config: Config, av: int = 0) -> Percept:
    """What autonomous vehicle number `av` (from 0) sees of the world."""
    return _seen(
        world.road,
        world.tick,
        world.episode_tick,
        world.avs[av],
        f"{Kind.AV}-{av + 1}",
        world.right,
        world.left,
        world.boards,
        yielding_movers(world, config),
        attentive_movers(world, config),
        world.driven,
        config.collision == "swept",
        world.movers,
        world.hazards,
    )
