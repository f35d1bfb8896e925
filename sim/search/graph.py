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


class Grid:
    """A map of free and blocked cells on which nothing moves, given as rows of text.

    "." and "G" are free, everything else is blocked, as in the maps of movingai.com (Sturtevant,
    "Benchmarks for grid-based pathfinding", 2012). With `corners` false a diagonal needs both cells
    beside it. A state is a cell index: row · width + column.
    """

    def __init__(self, rows: list[str], goal: int, moves: MoveSet, *, corners: bool = True) -> None:
        """A map, a goal (cell index: row · width + column) and a move set. Raises `ValueError`."""
        if not rows or len({len(row) for row in rows}) != 1:
            raise ValueError("a map has rows of one length")
        self.width, self.height = len(rows[0]), len(rows)
        self.moves = moves
        self._free = [sign in ".G" for row in rows for sign in row]
        self._goal = goal
        self._corners = corners
        straight = [step.cost for step in moves if (step.columns == 0) != (step.rows == 0)]
        slanted = [step.cost for step in moves if step.columns and step.rows]
        self._straight = min(straight, default=0)
        self._slanted = min(slanted, default=2 * self._straight)

    def steps(self, state: State) -> Iterable[tuple[int, State, int]]:
        """The free neighbours that a move leads to."""
        row, column = divmod(state, self.width)
        found = []
        for index, step in enumerate(self.moves):
            there = self._index(column + step.columns, row + step.rows)
            if there is None or not self._free[there]:
                continue
            if step.columns and step.rows and not self._corners:
                beside = (
                    self._index(column + step.columns, row),
                    self._index(column, row + step.rows),
                )
                if not all(cell is not None and self._free[cell] for cell in beside):
                    continue
            found.append((index, there, step.cost))
        return found

    def at_goal(self, state: State) -> bool:
        """Whether this is the goal's cell."""
        return state == self._goal

    def heuristic(self, state: State) -> int:
        """The way on an empty map: diagonals while they help, then straight on."""
        row, column = divmod(state, self.width)
        goal_row, goal_column = divmod(self._goal, self.width)
        long, short = sorted((abs(row - goal_row), abs(column - goal_column)), reverse=True)
        slanted = min(self._slanted, 2 * self._straight)
        return min(self._straight, slanted) * (long - short) + slanted * short

    def _index(self, column: int, row: int) -> int | None:
        inside = 0 <= column < self.width and 0 <= row < self.height
        return row * self.width + column if inside else None
