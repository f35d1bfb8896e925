"""Which movers beside a vehicle react to it, by a draw: `sim.rules.yielding` in compiled words."""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.compilation import compiled, fraction, word_at

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)


@compiled
def drawn_beside(key, tick, cell, bit, last_bit, share):
    """The columns beside the vehicle, as bits of its row, whose movers react to it in this tick.

    `key`: of the stream of the reaction and the episode; `cell`: the vehicle's; `bit`, `last_bit`: its column
    and the last one; `share`: the chance that a mover reacts.
    """
    beside = _ZERO
    if share > 0.0:
        draws = word_at(key, tick)
        if fraction(word_at(draws, cell - 1)) < share:
            beside |= (bit & ~_ONE) >> _ONE
        if fraction(word_at(draws, cell + 1)) < share:
            beside |= (bit & ~last_bit) << _ONE
    return beside
