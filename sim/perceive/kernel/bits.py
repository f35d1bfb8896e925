"""Cells of boards as bytes."""

from __future__ import annotations

import numpy as np

from sim.compilation import on_given_arrays


@on_given_arrays
def bit(boards, which, size, cell):
    """Whether a cell is on one of the boards, each of `size` bytes."""
    return boards[which * size + (cell >> 3)] >> (cell & 7) & 1


@on_given_arrays
def mark(marked, which, size, cell):
    """Put a cell on one of the boards of what is shown."""
    marked[which * size + (cell >> 3)] |= np.uint8(1 << (cell & 7))
