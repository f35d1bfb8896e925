"""What a search goes over: states, and what stepping from one to another costs.

A state is a whole number that its terrain makes and reads: a cell index where nothing moves, a cell at a
tick where something does.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from sim.search.step_costs import MoveSet

State = int


class SearchGraph(Protocol):
    """A graph of states, given by its steps. Costs are whole numbers and never negative."""

    moves: MoveSet

    def steps(self, state: State) -> Iterable[tuple[int, State, int]]:
        """(index of the move, where it leads, what it costs) for each step that may be taken."""

    def at_goal(self, state: State) -> bool:
        """Whether a way may end here."""

    def heuristic(self, state: State) -> int:
        """A lower bound of the cost to a goal; consistent: no step lowers it by more than it costs."""
