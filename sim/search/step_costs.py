"""A move set is data: offsets and what each costs, so that one search serves all kinds of grids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

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

WAIT: Final = Step(0, 0)
FOUR: Final[MoveSet] = (Step(0, -1), Step(-1, 0), Step(1, 0), Step(0, 1))
"""The four neighbours, each for 1."""


def eight(straight: int = 1, diagonal: int = 1) -> MoveSet:
    """The eight neighbours. Diagonals may cut corners: what forbids it is the terrain's to say."""
    return tuple(
        Step(columns, rows, diagonal if columns and rows else straight)
        for columns, rows in ((0, -1), (-1, 0), (1, 0), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1))
    )


def vehicle(weights: Weights) -> MoveSet:
    """The vehicle's six moves, in the order of `Move`."""
    return tuple(Step(*move.offset, weights.of(move)) for move in MOVES)
