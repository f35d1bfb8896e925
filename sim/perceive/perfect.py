"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.percept import Percept
from sim.perceive.sensor import NO_BELIEF, Belief
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


def perceive_truth(world: World, config: Config, ego: int = 0) -> Percept:
    """All that is, as autonomous vehicle number `ego` (from 0) sees it with perfect sight."""
    return _seen(
        world.road,
        world.tick,
        world.episode_tick,
        world.avs[ego],
        f"{Kind.AV}-{ego + 1}",
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


class PerfectSensor:
    """Sees the truth, every tick anew."""

    name = "perfect"
    stateless = True
    faithful = True

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:  # noqa: ARG002
        """See `Sensor.perceive`."""
        return perceive_truth(world, config, ego), NO_BELIEF
