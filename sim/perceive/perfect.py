"""The perfect sensor: all that is, as it is."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.perceive.percept import OtherEgo, Percept
from sim.rules.yielding import attentive_movers, yielding_movers
from sim.types import Move, ego_id
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
    "egos",
)
_NOTHING: dict[int, Move] = {}


def perceive(
    world: World,
    config: Config,
    av: int = 0,
    announced: Mapping[int, Move] = _NOTHING,
    parked: Collection[int] = (),
) -> Percept:
    """What ego number `av` (from 0) sees of the world.

    `announced`: the moves that other egos have told it of; `parked`: the egos that stay. Both by number.
    """
    return _seen(
        world.road,
        world.tick,
        world.episode_tick,
        world.avs[av],
        ego_id(av),
        world.potholes,
        world.barriers,
        world.right,
        world.left,
        world.pedestrians,
        yielding_movers(world, config),
        attentive_movers(world, config),
        world.driven,
        config.collision == "swept",
        world.movers,
        world.hazards,
        () if len(world.avs) == 1 else _others(world, av, announced, parked),
    )


def _others(
    world: World, av: int, announced: Mapping[int, Move], parked: Collection[int]
) -> tuple[OtherEgo, ...]:
    return tuple(
        OtherEgo(
            ego_id(number),
            cell,
            announced.get(number, Move.STAY),
            number in parked or cell < world.road.columns,
        )
        for number, cell in enumerate(world.avs)
        if number != av
    )
