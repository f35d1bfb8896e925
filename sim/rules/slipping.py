"""Moves that slip: on snow a step to the side may be lost.

A vehicle that slips makes its move without the sideways part: to the left or right it stays, of a diagonal
only the step forward is left. Grip is short where a vehicle is steered; moves that are straight never slip.
Whether one does is drawn by episode, tick and vehicle (`Config.slip_probability`), and nobody knows it
before: no forecast has it, and what searches claim would not hold, so that they claim nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from sim.randomness import Stream
from sim.types import Move

if TYPE_CHECKING:
    from sim.config import Config
    from sim.world import World

STRAIGHT: Final[Mapping[Move, Move]] = MappingProxyType(
    {
        Move.LEFT: Move.STAY,
        Move.RIGHT: Move.STAY,
        Move.FORWARD_LEFT: Move.FORWARD,
        Move.FORWARD_RIGHT: Move.FORWARD,
    }
)
"""What is left of a move that slips."""


def moves_made(world: World, moves: tuple[Move, ...], config: Config) -> tuple[Move, ...]:
    """The moves that are really made, in the order of `World.avs`, where these are tried."""
    share = config.slips
    if not share or not any(move in STRAIGHT for move in moves):
        return moves
    draws = Stream.of(config.seed, "slip", world.episode, world.episode_tick)
    return tuple(
        [
            STRAIGHT[move] if move in STRAIGHT and draws.uniform(number) < share else move
            for number, move in enumerate(moves)
        ]
    )
