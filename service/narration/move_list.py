"""Several moves in a row, in words: "forward, 2 × left"."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Final

from service.narration.sayings import Sayings
from sim.types import Move

MOST_RUNS: Final = 7
"""Runs of like moves that are told of a way."""


def moves_told(sayings: Sayings, moves: Sequence[Move]) -> str:
    """Moves in their order; those that are alike and follow each other are counted."""
    told = []
    for move, alike in groupby(moves):
        count, name = len(list(alike)), sayings.move(move, "name")
        told.append(name if count == 1 else sayings.say("soon", "times", count=count, move=name))
    return sayings.chained(told, ", ")


def way_told(sayings: Sayings, moves: Sequence[Move]) -> str:
    """The moves of a way, up to `MOST_RUNS` runs of like ones, and how many more there are."""
    runs, shown = 0, len(moves)
    for at, move in enumerate(moves):
        runs += at == 0 or move is not moves[at - 1]
        if runs > MOST_RUNS:
            shown = at
            break
    told = moves_told(sayings, moves[:shown])
    if shown == len(moves):
        return told
    return sayings.say("plan_course", "and_more", moves=told, count=len(moves) - shown)
