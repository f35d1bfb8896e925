"""The grid, and sets of its cells as integers (bitboards).

Cell (column, row) is bit `row * columns + column`. A set of cells is one Python integer, so `&`, `|`, `~` and
shifts work on a whole road of any size, as in chess engines (Slate & Atkin, "CHESS 4.5", 1977). A shift by
one is a sideways step, a shift by `columns` a step along the road.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import compress

from sim.types import Cell, Move

_WORD_BITS = 240
_WORD = (1 << _WORD_BITS) - 1
_FROM_DIGITS = bytes(digit == ord("1") for digit in range(256))

Board = int
"""A set of cells of one road."""


def bits(board: Board) -> Iterator[int]:
    """Yields the cell indices in a board, lowest first."""
    # Word by word: removing a bit from a long integer takes time in proportion to its length.
    offset = 0
    while board:
        word = board & _WORD
        while word:
            lowest = word & -word
            yield offset + lowest.bit_length() - 1
            word ^= lowest
        board >>= _WORD_BITS
        offset += _WORD_BITS


def cells_of(board: Board) -> list[int]:
    """Lists the cell indices in a board, lowest first; faster than `bits` for dense boards."""
    return list(compress(range(board.bit_length()), bin(board)[:1:-1].encode().translate(_FROM_DIGITS)))


def board_of(indices: Iterable[int]) -> Board:
    """Returns the board with these cell indices."""
    board = 0
    for index in indices:
        board |= 1 << index
    return board


def union(boards: Iterable[Board]) -> Board:
    """Every cell that is in one of the boards."""
    whole = 0
    for board in boards:
        whole |= board
    return whole


@dataclass(frozen=True, slots=True)
class Road:
    """A road of `columns` × `rows` cells; row 0 is the goal, column 0 is lane 1."""

    columns: int
    rows: int
    all: Board = field(init=False, repr=False, compare=False)
    left_edge: Board = field(init=False, repr=False, compare=False)
    right_edge: Board = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        left_edge = board_of([row * self.columns for row in range(self.rows)])
        object.__setattr__(self, "all", (1 << self.columns * self.rows) - 1)
        object.__setattr__(self, "left_edge", left_edge)
        object.__setattr__(self, "right_edge", left_edge << (self.columns - 1))

    @staticmethod
    @lru_cache(maxsize=64)
    def of(columns: int, rows: int) -> Road:
        """Returns the road of that size; one shared object per size."""
        return Road(columns, rows)

    @property
    def start(self) -> int:
        """The cell index where the first ego starts: last row, centre."""
        return self.index((self.columns // 2, self.rows - 1))

    def index(self, cell: Cell) -> int:
        """The index of a cell on the road."""
        return cell[1] * self.columns + cell[0]

    def cell(self, index: int) -> Cell:
        """The cell (column, row) of an index."""
        row, column = divmod(index, self.columns)
        return column, row

    def holds(self, cell: Cell) -> bool:
        """Whether a cell lies on the road."""
        return 0 <= cell[0] < self.columns and 0 <= cell[1] < self.rows

    def row(self, row: int) -> Board:
        """All cells of a row."""
        return ((1 << self.columns) - 1) << row * self.columns

    def column(self, column: int) -> Board:
        """All cells of a column."""
        return self.left_edge << column

    @property
    def between(self) -> Board:
        """All cells between the start row and the goal row, where things are placed."""
        return self.all & ~self.row(0) & ~self.row(self.rows - 1)

    def moved(self, index: int, move: Move) -> int | None:
        """The index of the cell a move leads to; None if that is off the road."""
        columns, rows = move.offset
        column = index % self.columns + columns
        target = index + columns + rows * self.columns
        return target if 0 <= column < self.columns and target >= 0 else None
