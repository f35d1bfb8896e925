"""The belief one tick on: `sim.perceive.bayes_filter.predict_layers` in machine code."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import compiled
from sim.perceive.belief import FIXED
from sim.perceive.kernel.bits import bit
from sim.perceive.kernel.places import (
    AVS,
    BELIEVED_FIXED,
    COLUMNS,
    FOLLOWED,
    FOLLOWED_RIGHT,
    HEAD,
    ROWS,
    THINGS,
    TICK_BEFORE,
)
from sim.perceive.kernel.tables import KINDS_SEEN, PERIOD_OF
from sim.perceive.log_odds import LIMIT
from sim.types import HAZARDS

_FIXED_KINDS: Final = len(HAZARDS)
_MOVING_KINDS: Final = KINDS_SEEN - _FIXED_KINDS


@compiled
def predict(numbers, boards, layers, mixing, least):
    """`sim.perceive.bayes_filter.predict_layers`; where the rule leads the movers is in `numbers`."""
    columns, rows, followed = numbers[COLUMNS], numbers[ROWS], numbers[FOLLOWED]
    cells = columns * rows
    size = (cells + 7) // 8
    at = HEAD + 3 * numbers[THINGS] + numbers[AVS]
    values = np.empty(followed, np.int64)
    for place in range(followed):
        layer, cell = numbers[at + place], numbers[at + followed + place]
        values[place] = layers[layer * cells + cell]
        layers[layer * cells + cell] = -LIMIT
    for place in range(_MOVING_KINDS):
        if numbers[TICK_BEFORE] % PERIOD_OF[place] == PERIOD_OF[place] - 1:
            right = (FIXED + 2 * place) * cells
            for row in range(rows):
                _drift(layers, right + row * columns, right + cells + row * columns, columns)
    for place in range(2 * _MOVING_KINDS):
        first = (FIXED + place) * cells
        for cell in range(first, first + cells):
            layers[cell] = mixing[place, layers[cell] + LIMIT]
    for cell in range(cells):
        if bit(boards, BELIEVED_FIXED, size, cell):
            edge = 1 if cell < columns or cell >= cells - columns else 0
            for place in range(2 * _MOVING_KINDS):
                there = (FIXED + place) * cells + cell
                layers[there] = min(layers[there], least[place, edge])
    for place in range(followed):
        cell = numbers[at + 2 * followed + place]
        moving = (numbers[at + place] - FIXED) // 2 * 2
        if not bit(boards, FOLLOWED_RIGHT, size, cell):
            moving += 1
        there = (FIXED + moving) * cells + cell
        layers[there] = max(layers[there], mixing[moving, values[place] + LIMIT])


@compiled
def _drift(layers, right, left, columns):
    """One row of one kind of mover one step on, with movers that turn at the edges."""
    turned_left, turned_right = layers[right + columns - 1], layers[left]
    for column in range(columns - 1, 0, -1):
        layers[right + column] = layers[right + column - 1]
    layers[right] = -LIMIT
    for column in range(columns - 1):
        layers[left + column] = layers[left + column + 1]
    layers[left + columns - 1] = -LIMIT
    layers[left + columns - 2] = max(layers[left + columns - 2], turned_left)
    layers[right + 1] = max(layers[right + 1], turned_right)
