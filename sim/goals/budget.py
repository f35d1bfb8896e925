"""The work that a search may do, counted and never timed, so that the same moment has the same answer.

A unit is one tick of the simplest planner on a road of the default size or less; twice the size costs twice.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from sim.config import Config

MOST_WORK: Final = 20_000
"""Units that one search may spend: about two seconds."""

CELLS_A_UNIT: Final = 240
"""Cells of the default road."""


class BudgetSpentError(Exception):
    """All the work that was allowed is done."""


class CancelledError(Exception):
    """Nobody waits for the answer any more."""


def _never() -> bool:
    return False


@dataclass(slots=True)
class Budget:
    """Units left, roads tried and ticks driven so far."""

    left: int = MOST_WORK
    cancelled: Callable[[], bool] = _never
    """asked before each piece of work"""
    tried: int = 0
    """roads that were measured"""
    driven: int = 0
    """ticks that planners drove"""

    def spend(self, config: Config, ticks: int, work: int = 1) -> None:
        """Count some ticks of a road of this size. Raises `BudgetSpentError` or `CancelledError`."""
        if self.cancelled():
            raise CancelledError
        cost = ticks * work * max(CELLS_A_UNIT, config.columns * config.rows) // CELLS_A_UNIT
        if cost > self.left:
            raise BudgetSpentError
        self.left -= cost
