"""The belief one tick on: `sim.perceive.bayes_filter.predict_layers` in machine code."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import on_given_arrays
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


@on_given_arrays
def predict(numbers, boards, layers, mixing, least, ahead):
    """`sim.perceive.bayes_filter.predict_layers` of the first `ahead` rows; `numbers` say where movers go."""
    columns, rows, followed = numbers[COLUMNS], numbers[ROWS], numbers[FOLLOWED]
    cells = columns * rows
    size = (cells + 7) // 8
    at = HEAD + 3 * numbers[THINGS] + numbers[AVS]
    for place in range(followed):
        layer, cell = numbers[at + place], numbers[at + followed + place]
        numbers[at + followed + place] = layers[layer * cells + cell]  # where it is kept until below
        layers[layer * cells + cell] = -LIMIT
    for place in range(_MOVING_KINDS):
        right = (FIXED + 2 * place) * cells
        if numbers[TICK_BEFORE] % PERIOD_OF[place] == PERIOD_OF[place] - 1:
            for row in range(ahead):
                _drift(
                    layers, right + row * columns, right + cells + row * columns, columns, mixing, 2 * place
                )
        else:
            for layer in range(2):
                mixed, start = mixing[2 * place + layer], right + layer * cells
                own = layers[start : start + ahead * columns]
                for cell in range(ahead * columns):
                    own[cell] = mixed[np.uintp(own[cell] + LIMIT)]
    for byte in range((ahead * columns + 7) // 8):
        believed = boards[BELIEVED_FIXED * size + byte]
        for cell in range(8 * byte, 8 * byte + 8 if believed else 0):
            if believed >> (cell & 7) & 1:
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
        layers[there] = max(layers[there], mixing[moving, numbers[at + followed + place] + LIMIT])


@on_given_arrays
def _drift(layers, right, left, columns, mixing, place):
    """One row of one kind of mover one step on and mixed with the prior; movers turn at the edges."""
    rightward, leftward = layers[right : right + columns], layers[left : left + columns]
    mixed_right, mixed_left = mixing[place], mixing[place + 1]
    turned_left, turned_right = rightward[columns - 1] + LIMIT, leftward[0] + LIMIT
    for column in range(columns - 1, 0, -1):
        rightward[column] = mixed_right[np.uintp(rightward[column - 1] + LIMIT)]
    rightward[0] = mixed_right[0]
    for column in range(columns - 1):
        leftward[column] = mixed_left[np.uintp(leftward[column + 1] + LIMIT)]
    leftward[columns - 1] = mixed_left[0]
    # What is likelier stays so when it is mixed.
    leftward[columns - 2] = max(leftward[columns - 2], mixed_left[np.uintp(turned_left)])
    rightward[1] = max(rightward[1], mixed_right[np.uintp(turned_right)])
