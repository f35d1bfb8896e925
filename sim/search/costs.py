"""What a way is charged for, and how preferences shift it. Whole numbers, so that every engine adds the same.

A step that arrives in a cell at a tick costs

    tick + (sideways | diagonal | stay, by the move)
         + fixed · [a pothole or barrier is in one of the eight cells around]
         + mover · Σ_{d = 1 … buffer} [a mover is then expected within d cells, diagonals counted as one]
         + doubt · [levels of doubt that the cell reaches: something fixed may be in it, and is not heeded]

The balance is mostly time, and a little is given for room: three steps away from a mover are worth a tick and
the move aside. `fastest` gives nothing. What every preference changes, measured, is the second table of
bench/FAMILIES.md. Simplification: smoothness is a charge on each move and not on changes of direction,
so that a state is (column, row, tick) and nothing more.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from sim.actions import Preference
from sim.config import Config
from sim.types import MOVES, Move


@dataclass(frozen=True, slots=True)
class Weights:
    """The charges of one step, each a whole number."""

    tick: int
    sideways: int
    diagonal: int
    stay: int
    fixed: int
    mover: int
    buffer: int
    """cells around a mover that are charged for"""
    doubt: int
    """for each level of `Percept.doubtful`; with the perfect sensor there are none"""

    def of(self, move: Move) -> int:
        """What a move costs by itself, wherever it leads."""
        return (
            self.tick
            + (
                0,
                self.sideways,
                self.sideways,
                self.diagonal,
                self.diagonal,
                self.stay,
            )[MOVES.index(move)]
        )


_LATEST = Weights(tick=60, sideways=12, diagonal=9, stay=4, fixed=2, mover=24, buffer=0, doubt=40)
BALANCED: Final[dict[int, Weights]] = {
    1: Weights(tick=60, sideways=4, diagonal=3, stay=2, fixed=1, mover=2, buffer=0, doubt=40),
    2: _LATEST,
    3: _LATEST,
}
"""Without preferences, by version of the rules; `buffer` is added to the configuration's `safety_buffer`."""

SHIFTS: Final[dict[Preference, Weights]] = {
    "avoid_potholes": Weights(tick=0, sideways=0, diagonal=0, stay=0, fixed=40, mover=0, buffer=0, doubt=40),
    "smooth_ride": Weights(tick=0, sideways=40, diagonal=30, stay=20, fixed=0, mover=0, buffer=0, doubt=0),
    "fastest": Weights(tick=10_000, sideways=0, diagonal=0, stay=0, fixed=0, mover=0, buffer=0, doubt=0),
    "cautious": Weights(tick=0, sideways=0, diagonal=0, stay=0, fixed=8, mover=30, buffer=1, doubt=120),
}
"""What each preference adds to every charge."""


TICKS_ALONE: Final = Weights(tick=1, sideways=0, diagonal=0, stay=0, fixed=0, mover=0, buffer=0, doubt=0)
"""Charges by which a way costs its ticks and nothing else."""


def weights(config: Config) -> Weights:
    """The charges that a configuration asks for."""
    return weights_of(config.rules, config.preferences, config.safety_buffer)


@lru_cache(maxsize=256)
def weights_of(rules: int, preferences: tuple[Preference, ...], safety_buffer: int) -> Weights:
    """The charges by the version of the rules, the wishes and the buffer."""
    parts = (BALANCED[rules], *(SHIFTS[preference] for preference in preferences))
    return Weights(
        tick=sum(part.tick for part in parts),
        sideways=sum(part.sideways for part in parts),
        diagonal=sum(part.diagonal for part in parts),
        stay=sum(part.stay for part in parts),
        fixed=sum(part.fixed for part in parts),
        mover=sum(part.mover for part in parts),
        buffer=safety_buffer + sum(part.buffer for part in parts),
        doubt=sum(part.doubt for part in parts),
    )
