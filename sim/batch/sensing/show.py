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
def show_words(layers, threshold, least, least_mover, columns, rows, ahead, block, lane, found, eights):
    """Write what is believed in the first `ahead` rows into a lane of a block; nothing is behind them.

    `layers` (layers · cells; int16); `least`, `least_mover`: `least_shown`; `found` (cells, rounded up to
    eights; uint8) and `eights`, the same as words: scratch, whose end is 0.
    """
    cells, per_word = columns * rows, 64 // columns
    near = ahead * columns
    for word in range(-(-rows // per_word)):
        at = word * PLANES * LANES + lane
        for plane in range(PLANES):
            block[at + plane * LANES] = _ZERO
    near_eights = (near + 7) // 8
    eights[near_eights - 1] = _ZERO
    for cell in range(near):
        found[cell] = layers[cell] >= least
    for layer in range(1, FIXED):
        for cell in range(near):
            found[cell] |= layers[layer * cells + cell] >= least
    for layer in range(FIXED, LAYERS):
        for cell in range(near):
            found[cell] |= layers[layer * cells + cell] >= least_mover
    word, start = 0, 0
    for eight in range(near_eights):
        if eights[eight] == _ZERO:  # as most are
            continue
        for cell in range(8 * eight, 8 * eight + 8):
            if found[cell]:
                while cell >= start + per_word * columns:
                    word, start = word + 1, start + per_word * columns
                bit = _ONE << np.uint64(cell - start)
                _show_cell(
                    layers,
                    threshold,
                    cells,
                    cell,
                    block,
                    word * PLANES * LANES + lane,
                    bit,
                    least,
                    least_mover,
                )


@on_given_arrays
def _show_cell(layers, threshold, cells, cell, block, at, bit, least, least_mover):
    """What is shown in one cell; `sim.perceive.kernel.show` says why."""
    standing, likely = -1, 0.0
    for kind in range(_FIXED_KINDS):
        value = layers[np.uintp(LAYER_OF[kind] * cells + cell)]
        if value >= least:
            chance = min(CHANCES[np.uintp(value + LIMIT)], 1.0)
            if standing < 0 or chance > likely:
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
        value, other = layers[np.uintp(there)], layers[np.uintp(there + cells)]
        if max(value, other) < least_mover:
            continue
        right, left = CHANCES[np.uintp(value + LIMIT)], CHANCES[np.uintp(other + LIMIT)]
        if right + left >= threshold:
            chance = min(right + left, 1.0)
            if moving < 0 or chance > likely:
                moving, likely, rightward = kind, chance, right >= left
    if moving >= 0:
        block[at + (RIGHT if rightward else LEFT) * LANES] |= bit
        if moving == _WALKER:
            block[at + WALKERS * LANES] |= bit
