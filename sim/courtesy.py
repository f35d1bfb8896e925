"""Which movers give way to autonomous vehicles in a tick.

Drawn by cell, episode and tick of the episode, so that neither edits elsewhere nor a restart of
the episode change who is courteous. Only a mover next to a vehicle can have a reason to be.
"""

from __future__ import annotations

from sim.config import Config
from sim.randomness import Stream
from sim.road import Board, bits, board_of
from sim.world import World


def yielding(world: World, config: Config) -> Board:
    """The movers that count an autonomous vehicle's cell as blocked in the coming tick."""
    if config.courtesy == 0.0:
        return 0
    vehicles = world.driven
    near = (vehicles >> 1 | vehicles << 1) & world.moving
    draws = Stream.of(config.seed, "courtesy", world.episode, world.episode_tick)
    return board_of([cell for cell in bits(near) if draws.uniform(cell) < config.courtesy])
