"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.percept import CERTAIN, OtherEgo, Percept
from sim.perceive.sensor import NO_BELIEF, Belief
from sim.rules.traffic_cache import cached_reactions
from sim.types import Move, ego_id
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
    "dynamics",
    "behaviour",
    "egos",
    "likelihoods",
)
_NOTHING: dict[int, Move] = {}


def perceive_truth(
    world: World,
    config: Config,
    ego: int = 0,
    announced: Mapping[int, Move] = _NOTHING,
    parked: Collection[int] = (),
) -> Percept:
    """The ground truth as a percept of ego number `ego` (from 0).

    `announced`: the moves that other egos have told it of; `parked`: the egos that stay. Both by number.
    """
    reactions = cached_reactions(world, config)
    return _seen(
        world.road,
        world.tick,
        world.episode_tick,
        world.avs[ego],
        ego_id(ego),
        world.right,
        world.left,
        world.boards,
        reactions.yielding,
        reactions.attentive,
        world.driven,
        config.collision == "swept",
        world.movers,
        world.hazards,
        config.dynamics,
        config.behaviour,
        () if len(world.avs) == 1 else other_egos(world, ego, announced, parked),
        CERTAIN,
    )


def other_egos(
    world: World, ego: int, announced: Mapping[int, Move], parked: Collection[int]
) -> tuple[OtherEgo, ...]:
    """What the other egos tell ego number `ego` of themselves; no sensor has a part in it."""
    return tuple(
        OtherEgo(
            ego_id(number),
            cell,
            announced.get(number, Move.STAY),
            number in parked or cell < world.road.columns,
        )
        for number, cell in enumerate(world.avs)
        if number != ego
    )


class PerfectSensor:
    """Sees the truth, every tick anew."""

    name = "perfect"
    stateless = True
    faithful = True

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:  # noqa: ARG002
        """See `Sensor.perceive`."""
        return perceive_truth(world, config, ego), NO_BELIEF
