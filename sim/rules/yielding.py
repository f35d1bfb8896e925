"""Which movers react to autonomous vehicles in a tick: those that give way, and those that brake.

Both are drawn by cell, episode and tick of the episode, so that neither edits elsewhere nor a restart of the
episode change who reacts. Only a mover next to a vehicle can have a reason to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.randomness import Stream
from sim.world.grid import Board, bits, board_of

if TYPE_CHECKING:
    from sim.config import Config
    from sim.world import World


def yielding_movers(world: World, config: Config, near: Board) -> Board:
    """Of the movers beside a vehicle, those that count its cell as blocked in the coming tick."""
    return _drawn(world, config, "courtesy", config.courtesy, near) if config.courtesy else 0


def attentive_movers(world: World, config: Config, near: Board) -> Board:
    """Of the movers beside a vehicle, those that brake in the coming tick if it stands still before them."""
    return _drawn(world, config, "attentive", config.attentive, near) if config.attentive else 0


def movers_beside(world: World) -> Board:
    """The movers next to an autonomous vehicle, in its row: those that may have a reason to react."""
    # Cells beside it across the edge of the road are in another row; a mover there meets no vehicle.
    vehicles = world.driven
    return (vehicles >> 1 | vehicles << 1) & (world.right | world.left)


def _drawn(world: World, config: Config, purpose: str, share: float, near: Board) -> Board:
    if share == 1.0:
        return near
    draws = Stream.of(config.seed, purpose, world.episode, world.episode_tick)
    return board_of([cell for cell in bits(near) if draws.uniform(cell) < share])
