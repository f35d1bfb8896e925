"""What of a belief is shown: `sim.perceive.grid_sensor.show` in machine code."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import compiled
from sim.perceive.belief import FIXED, LAYERS
from sim.perceive.kernel.bits import mark
from sim.perceive.kernel.places import (
    COLUMNS,
    FIXED_THINGS,
    HEAD,
    HERE,
    ROWS,
    SEEN_BOARDS,
    SEEN_DOUBTS,
    SEEN_FIXED,
    SEEN_HOLDING,
    SEEN_LEFT,
    SEEN_OTHERS,
    SEEN_RIGHT,
    SHOWN_FIXED,
    SHOWN_HEAD,
    SHOWN_MOVERS,
    THINGS,
    TIES,
    TRIPLE,
)
from sim.perceive.kernel.tables import BOARD_OF, CHANCES, HOLDS, KINDS_SEEN, LAYER_OF, LEVELS
from sim.perceive.log_odds import LIMIT
from sim.types import HAZARDS

_FIXED_KINDS: Final = len(HAZARDS)
_LEVELS: Final = len(LEVELS)


@compiled
def _likelihood(shown, chance):
    """A probability rounded to thousandths; as it is where that is too near a tie, which is noted."""
    scaled_up = chance * 1000.0
    if abs(scaled_up - np.floor(scaled_up) - 0.5) < 1e-6:
        shown[TIES] = 1
        return chance
    return np.rint(scaled_up) / 1000.0


@compiled
def _show_cell(numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, fixed):
    """What is shown in a cell: of hazards (`fixed`) or of movers. Returns how many were added.

    `fixed_kinds`: by cell, the kind of the hazard that is shown there, −1 for none.
    """
    cells, size = numbers[COLUMNS] * numbers[ROWS], (numbers[COLUMNS] * numbers[ROWS] + 7) // 8
    best, likely, right = -1, 0.0, False
    for kind in range(0 if fixed else _FIXED_KINDS, _FIXED_KINDS if fixed else KINDS_SEEN):
        at = LAYER_OF[kind] * cells + cell
        chance, heads_right = CHANCES[layers[at] + LIMIT], False
        if not fixed:
            other = CHANCES[layers[at + cells] + LIMIT]
            heads_right = chance >= other
            chance = chance + other
        if chance < threshold:
            continue
        chance = min(chance, 1.0)
        if best < 0 or chance > likely:
            best, likely, right = kind, chance, heads_right
    if best < 0 or (not fixed and fixed_kinds[cell] >= 0 and not HOLDS[fixed_kinds[cell]]):
        return 0
    if fixed:
        fixed_kinds[cell] = best
        mark(marked, SEEN_FIXED, size, cell)
        if HOLDS[best]:
            mark(marked, SEEN_HOLDING, size, cell)
    else:
        mark(marked, SEEN_RIGHT if right else SEEN_LEFT, size, cell)
        if BOARD_OF[best] >= 0:
            mark(marked, SEEN_OTHERS, size, cell)
    if BOARD_OF[best] >= 0:
        mark(marked, SEEN_BOARDS + BOARD_OF[best], size, cell)
    place = shown[SHOWN_FIXED] + shown[SHOWN_MOVERS]
    at = SHOWN_HEAD + TRIPLE * place
    shown[at], shown[at + 1], shown[at + 2] = cell, best, _thing_at(numbers, cell, best, fixed)
    likelihoods[place] = _likelihood(shown, likely)
    return 1


@compiled
def _thing_at(numbers, cell, kind, fixed):
    """The place of the thing of that kind in that cell, −1 where there is none."""
    things, standing = numbers[THINGS], numbers[FIXED_THINGS]
    for thing in range(0 if fixed else standing, standing if fixed else things):
        if numbers[HEAD + thing] == cell:
            return thing if numbers[HEAD + things + thing] == kind else -1
    return -1


@compiled
def show(numbers, layers, threshold, shown, likelihoods, marked):
    """What is believed as far as the vehicle's own row: `sim.perceive.grid_sensor.show`."""
    columns = numbers[COLUMNS]
    cells = columns * numbers[ROWS]
    size, ahead = (cells + 7) // 8, (numbers[HERE] // columns + 1) * columns
    fixed_kinds = np.full(ahead, -1, np.int64)
    # Most cells hold nothing, which whole numbers say quickly: chances grow with log odds.
    least = np.searchsorted(CHANCES, threshold) - LIMIT
    least_mover = np.searchsorted(CHANCES, threshold / 2) - LIMIT - 1
    least_doubt = np.searchsorted(CHANCES, LEVELS[0]) - LIMIT
    likeliest = _likeliest(layers, cells, ahead, 0, FIXED)
    moving = _likeliest(layers, cells, ahead, FIXED, LAYERS)
    for cell in range(ahead):
        if likeliest[cell] >= least:
            shown[SHOWN_FIXED] += _show_cell(
                numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, True
            )
    for cell in range(ahead):
        if moving[cell] >= least_mover:
            shown[SHOWN_MOVERS] += _show_cell(
                numbers, layers, threshold, shown, likelihoods, marked, cell, fixed_kinds, False
            )
    for cell in range(ahead):
        if likeliest[cell] >= least_doubt and fixed_kinds[cell] < 0:
            for level in range(_LEVELS):
                if CHANCES[likeliest[cell] + LIMIT] >= LEVELS[level]:
                    mark(marked, SEEN_DOUBTS + level, size, cell)


@compiled
def _likeliest(layers, cells, ahead, first, last):
    """The greatest log odds of some layers in each of the first `ahead` cells."""
    found = layers[first * cells : first * cells + ahead].copy()
    for layer in range(first + 1, last):
        for cell in range(ahead):
            found[cell] = max(found[cell], layers[layer * cells + cell])
    return found
