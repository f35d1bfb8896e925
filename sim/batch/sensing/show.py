"""What of a belief is shown, as words of a road: `sim.perceive.kernel.show` without names and likelihoods."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.layout import FIXED as FIXED_PLANE
from sim.batch.layout import HOLES, LANES, LEFT, PLANES, RIGHT, WALKERS
from sim.compilation import on_given_arrays
from sim.perceive.belief import FIXED, LAYERS
from sim.perceive.kernel.tables import CHANCES, HOLDS, KINDS_SEEN, LAYER_OF
from sim.perceive.log_odds import LIMIT
from sim.perceive.look import NUMBER
from sim.types import HAZARDS, Kind

_FIXED_KINDS: Final = len(HAZARDS)
_WALKER: Final = NUMBER[Kind.PEDESTRIAN]
_ONE: Final = np.uint64(1)
_ZERO: Final = np.uint64(0)


@on_given_arrays
def least_shown(threshold):
    """The log odds from which a fixed thing, and a mover by its heading, may be likely enough to be shown."""
    least = np.int16(np.searchsorted(CHANCES, threshold) - LIMIT)
    return least, np.int16(max(-LIMIT, np.searchsorted(CHANCES, threshold / 2) - LIMIT - 1))


@on_given_arrays
def show_words(layers, threshold, least, least_mover, columns, rows, ahead, block, lane, found):
    """Write what is believed in the first `ahead` rows into a lane of a block; nothing is behind them.

    `layers` (layers · cells; int16); `least`, `least_mover`: `least_shown`; `found` (2, cells; int16):
    scratch.
    """
    cells, per_word = columns * rows, 64 // columns
    near = ahead * columns
    for word in range(-(-rows // per_word)):
        at = word * PLANES * LANES + lane
        for plane in range(PLANES):
            block[at + plane * LANES] = _ZERO
    likeliest, moving = found[0], found[1]
    for cell in range(near):
        likeliest[cell], moving[cell] = layers[cell], layers[FIXED * cells + cell]
    for layer in range(1, FIXED):
        for cell in range(near):
            likeliest[cell] = max(likeliest[cell], layers[layer * cells + cell])
    for layer in range(FIXED + 1, LAYERS):
        for cell in range(near):
            moving[cell] = max(moving[cell], layers[layer * cells + cell])
    for cell in range(near):
        if likeliest[cell] >= least or moving[cell] >= least_mover:
            row = cell // columns
            bit = _ONE << np.uint64(row % per_word * columns + cell % columns)
            at = row // per_word * PLANES * LANES + lane
            _show_cell(layers, threshold, cells, cell, block, at, bit)


@on_given_arrays
def _show_cell(layers, threshold, cells, cell, block, at, bit):
    """What is shown in one cell; `sim.perceive.kernel.show` says why."""
    standing, likely = -1, 0.0
    for kind in range(_FIXED_KINDS):
        chance = min(CHANCES[layers[LAYER_OF[kind] * cells + cell] + LIMIT], 1.0)
        if chance >= threshold and (standing < 0 or chance > likely):
            standing, likely = kind, chance
    if standing >= 0:
        block[at + FIXED_PLANE * LANES] |= bit
        if HOLDS[standing]:
            block[at + HOLES * LANES] |= bit
        else:
            return
    moving, likely, rightward = -1, 0.0, False
    for kind in range(_FIXED_KINDS, KINDS_SEEN):
        there = LAYER_OF[kind] * cells + cell
        right, left = CHANCES[layers[there] + LIMIT], CHANCES[layers[there + cells] + LIMIT]
        if right + left >= threshold:
            chance = min(right + left, 1.0)
            if moving < 0 or chance > likely:
                moving, likely, rightward = kind, chance, right >= left
    if moving >= 0:
        block[at + (RIGHT if rightward else LEFT) * LANES] |= bit
        if moving == _WALKER:
            block[at + WALKERS * LANES] |= bit
