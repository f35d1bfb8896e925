"""A road's boards cut at row boundaries into 64-bit words, and worlds side by side in blocks.

Rows never interact in the movers' rule, so a word of whole rows can be moved by itself. A block
holds `LANES` worlds; within it the same word of all its worlds lies side by side, so that one
instruction serves several worlds. All planes of a word lie at fixed distances from one another,
which lets a compiler see that they do not overlap.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.world.grid import Board, Road

Words = NDArray[np.uint64]

LANES: Final = 64
"""Worlds in a block."""

RIGHT, LEFT, FIXED, HOLES, WALKERS = range(5)
PLANES: Final = 5
"""Boards of a word: movers by heading, potholes and barriers, potholes alone, pedestrians."""

(
    WORD,
    SHIFT,
    COLUMN_BIT,
    CELL,
    EPISODE_TICK,
    OUTCOME,
    SINCE_END,
    MOVES,
    ENDS,
    TICKS_TO_GOAL,
    ASKED,
    COURTESY_KEY,
    ATTENTIVE_KEY,
    SWEPT,
    BRAKING,
    WATCHING,
    IN_ROW,
    KEPT_AT,
    KEPT_RIGHT,
    KEPT_LEFT,
    KEPT_WALKERS,
    KEPT_RIGHT_AHEAD,
    KEPT_LEFT_AHEAD,
    KEPT_WALKERS_AHEAD,
    YIELDING,
    OWN_ROW,
    NEXT_ROW,
    CAME_RIGHT,
    CAME_LEFT,
    CAME_RIGHT_AHEAD,
    CAME_LEFT_AHEAD,
    HELD_BACK,
) = range(32)
LANE_PLANES: Final = 32
"""What a world has once: where its vehicle is (word, bit of its row's first cell, its column as a bit,
cell index), the clock and the end of its episode, packed counters, the keys of its draws, which rules hold
(all ones or 0: bodies are swept, movers brake, a situation that repeats is STUCK), the watch for that
(`sim.repetition`), and what a tick hands from one loop to the next.

The watch: `IN_ROW` counts ticks since the ego came into its row, all ones before the first is seen; the
situation is renewed after 1, 3, 7, 15, ... of them. `KEPT_AT` is twice the cell, plus the beat; the other
planes are the words that hold the ego's row and the one ahead."""


SPAWN_PROBABILITY, POTHOLE_PROBABILITY, COURTESY, ATTENTIVE = range(4)
"""Columns of a batch's table of probabilities (float64)."""
VEHICLES, PEDESTRIANS, BARRIERS, POTHOLES, SEED, EPISODE, HOLD_TICKS, SOLVABLE = range(8)
"""Columns of its table of whole numbers (int64); a number of −1 means: drawn row by row."""
QUEUE_SEED, QUEUE_OUTCOME, QUEUE_MOVES = range(3)
"""Columns of the queue of a relay (uint64): what episodes are drawn from, how they ended, packed counters."""


@dataclass(frozen=True, slots=True)
class Layout:
    """How a road of `columns` × `rows` is cut."""

    columns: int
    rows: int

    @staticmethod
    @lru_cache(maxsize=256)
    def of(columns: int, rows: int) -> Layout:
        """The layout of that size; columns ≤ 64."""
        return Layout(columns, rows)

    @property
    def road(self) -> Road:
        """The road in its uncut form."""
        return Road.of(self.columns, self.rows)

    @property
    def rows_per_word(self) -> int:
        """Rows in each word (the last may hold fewer)."""
        return 64 // self.columns

    @property
    def words(self) -> int:
        """Words that hold a board of the whole road."""
        return -(-self.rows // self.rows_per_word)

    @property
    def left_edge(self) -> int:
        """The first column within a word."""
        return sum(1 << row * self.columns for row in range(self.rows_per_word))

    @property
    def right_edge(self) -> int:
        """The last column within a word."""
        return self.left_edge << self.columns - 1

    def cut(self, board: Board) -> list[int]:
        """The words of a board, destination first."""
        size = self.rows_per_word * self.columns
        return [board >> word * size & (1 << size) - 1 for word in range(self.words)]

    def joined(self, words: Words) -> Board:
        """The board of these words (shape: words)."""
        size = self.rows_per_word * self.columns
        return sum(int(word) << index * size for index, word in enumerate(words))
