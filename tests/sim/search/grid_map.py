"""A map of free and blocked cells as a search graph: the benchmark maps that A* is tested on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from sim.search.graph import State
from sim.search.step_costs import MoveSet, Step

WAIT: Final = Step(0, 0)
FOUR: Final[MoveSet] = (Step(0, -1), Step(-1, 0), Step(1, 0), Step(0, 1))
"""The four neighbours, each for 1."""


def eight(straight: int = 1, diagonal: int = 1) -> MoveSet:
    """The eight neighbours. Diagonals may cut corners: what forbids it is the terrain's to say."""
    return tuple(
        Step(columns, rows, diagonal if columns and rows else straight)
        for columns, rows in ((0, -1), (-1, 0), (1, 0), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1))
    )


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
