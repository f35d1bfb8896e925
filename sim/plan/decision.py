"""What a planner hands on: a move, and for every move what spoke for or against it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from sim.forecast import StepVerdict
from sim.types import Cell, Move


@dataclass(frozen=True, slots=True)
class Option:
    """One move as the planner saw it."""

    move: Move
    cell: Cell | None
    """where it leads; None is off the road"""
    reason: StepVerdict
    """what the step would meet"""
    cost: float | None
    """the lower the better, in the planner's own measure; None means not to be had, or for a free cell
    that no way leads on from there"""
    causes: tuple[str, ...]
    """ids of the things that would be met"""

    @property
    def dead_end(self) -> bool:
        """Whether the step meets nothing, but its planner knows of no way on from there.

        Not to be said of a planner of another package (`Measure.OWN`), whose costs may mean anything.
        """
        return self.cost is None and not self.reason.blocks

    @property
    def verdict(self) -> str:
        """`free`, `blocked` or `off_road`."""
        if self.reason is StepVerdict.OFF_ROAD:
            return "off_road"
        return "blocked" if self.reason.blocks else "free"


class Measure(StrEnum):
    """What a planner's costs are."""

    RANK = "rank"
    """a move's place in a fixed order"""
    COST = "cost"
    """the charges (`sim.search.costs`) of the move and the cheapest way on, to the goal"""
    TICKS = "ticks"
    """ticks of the quickest way to the goal that begins with the move"""
    OWN = "own"
    """a measure of the planner's own, of which nothing is claimed: it comes from another package"""


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision taken in the world of `tick`; it leads to the world of `tick + 1`."""

    tick: int
    av: str
    planner: str
    """name of the planner, or `manual` when a person chose"""
    move: Move
    options: tuple[Option, ...]
    """all six moves, the most preferred first"""
    asked: Move | None = None
    """what a person asked for; it was held back if it differs from `move`"""
    measure: Measure = Measure.RANK
    """what the options' costs measure"""
    fault: str | None = None
    """what the planner did instead of answering; the ego stays"""
    timed_out: bool = False
    """whether the fault was that it did not answer in time, which another run may not repeat"""

    @property
    def held_back(self) -> bool:
        """Whether a person's move was not taken because its cell would not be free."""
        return self.asked is not None and self.asked is not self.move

    @property
    def weight(self) -> int:
        """How much there is to say: 0 nothing was in the way, 1 a way round, 2 a wait or worse."""
        move, asked = self.move, self.asked
        if self.fault is not None or (asked is not None and asked is not move) or move is Move.STAY:
            return 2
        return 2 if self.chosen.cost is None else 0 if move is Move.FORWARD else 1

    @property
    def preferred(self) -> tuple[Option, ...]:
        """The moves that come before the one taken."""
        return self.options[: self.options.index(self.chosen)]

    def option(self, move: Move) -> Option:
        """The trace of one move. Raises `ValueError` where it was not looked at."""
        for option in self.options:
            if option.move is move:
                return option
        raise ValueError(f"there is no option {move}")

    @property
    def chosen(self) -> Option:
        """The trace of the move taken."""
        return self.option(self.move)
