"""What a sensor is: a pure function of the world, the configuration and its belief so far."""

from __future__ import annotations

from typing import Final, Protocol, TypeAlias

from sim.config import Config
from sim.perceive.percept import Percept
from sim.world import World

Belief: TypeAlias = object
"""What a sensor carries from tick to tick: any immutable value. Equal beliefs have equal effects."""

NO_BELIEF: Final = None
"""The belief at the beginning of an episode, and always that of a stateless sensor."""


class Sensor(Protocol):
    """One way of looking at the road.

    It keeps nothing of its own and draws from streams of `Config.seed` alone (`sim.randomness`), so that a
    session replays tick by tick, and a look can be repeated on a changed road.
    """

    @property
    def name(self) -> str:
        """What it is chosen by."""

    @property
    def stateless(self) -> bool:
        """Whether its belief is always `NO_BELIEF`."""

    @property
    def faithful(self) -> bool:
        """Whether the percept is always the truth."""

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """What the vehicle number `ego` (from 0) sees in this tick, and the belief for the next one.

        Things that are not there have ids of their own (`sim.types.phantom_id`).
        """
