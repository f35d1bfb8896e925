"""Cells of boards as bytes."""

from __future__ import annotations

import numpy as np

from sim.compilation import compiled


@compiled
def bit(boards, which, size, cell):
    """Whether a cell is on one of the boards, each of `size` bytes."""
    return boards[which * size + (cell >> 3)] >> (cell & 7) & 1


@compiled
def mark(marked, which, size, cell):
    """Put a cell on one of the boards of what is shown."""
    marked[which * size + (cell >> 3)] |= np.uint8(1 << (cell & 7))
