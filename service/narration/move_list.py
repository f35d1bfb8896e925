"""Several moves in a row, in words: "forward, 2 × left"."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from service.narration.sayings import Sayings
from sim.types import Move


def moves_told(sayings: Sayings, moves: Sequence[Move]) -> str:
    """Moves in their order; those that are alike and follow each other are counted."""
    told = []
    for move, alike in groupby(moves):
        count, name = len(list(alike)), sayings.move(move, "name")
        told.append(name if count == 1 else sayings.say("soon", "times", count=count, move=name))
    return sayings.chained(told, ", ")
