"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.percept import Percept
from sim.rules.traffic_cache import cached_reactions
from sim.types import Kind
from sim.world import World

_seen = fast_constructor(
    Percept,
    "road",
    "tick",
    "episode_tick",
    "ego",
    "ego_id",
    "potholes",
    "barriers",
    "right",
    "left",
    "pedestrians",
    "yielding",
    "attentive",
    "vehicles",
    "swept",
    "movers",
    "hazards",
    "dynamics",
    "behaviour",
)


def perceive(world: World, config: Config, av: int = 0) -> Percept:
    """What autonomous vehicle number `av` (from 0) sees of the world."""
    reactions = cached_reactions(world, config)
    return _seen(
        world.road,
        world.tick,
        world.episode_tick,
        world.avs[av],
        f"{Kind.AV}-{av + 1}",
        world.potholes,
        world.barriers,
        world.right,
        world.left,
        world.pedestrians,
        reactions.yielding,
        reactions.attentive,
        world.driven,
        config.collision == "swept",
        world.movers,
        world.hazards,
        config.dynamics,
        config.behaviour,
    )
