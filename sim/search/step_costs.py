"""A move set is data: offsets and what each costs, so that one search serves all kinds of grids."""

from __future__ import annotations

from dataclasses import dataclass

from sim.search.costs import Weights
from sim.types import MOVES


@dataclass(frozen=True, slots=True)
class Step:
    """One move: (columns, rows) it adds to a cell, and what it costs by itself."""

    columns: int
    rows: int
    cost: int = 1


MoveSet = tuple[Step, ...]
"""The moves there are; where two ways cost the same, the earlier move is preferred."""


def ego_moves(weights: Weights) -> MoveSet:
    """The ego's six moves, in the order of `Move`."""
    return tuple(Step(*move.offset, weights.of(move)) for move in MOVES)
