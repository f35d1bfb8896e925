"""Seeds of the environments, and the state of a random generator as a JSON value.

A seed up to 2⁵³ − 1 is used as the seed of the road's configuration. A larger one is folded: the 53 highest
bits of the first 64-bit word that `numpy.random.SeedSequence` makes of it are used instead.
"""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Integral
from typing import Any, Final

import numpy as np

from sim.randomness import MAX_SEED

DRAWN_BELOW: Final = 2**32
"""Seeds that are not given are drawn below this."""

_UNUSED_BITS: Final = 64 - MAX_SEED.bit_length()


def check_seed(seed: object) -> int:
    """Returns a seed as a Python integer. Raises `TypeError` for non-integers, `ValueError` if negative."""
    if isinstance(seed, bool | np.bool_) or not isinstance(seed, Integral):
        raise TypeError(f"a seed is an integer of 0 or more, not {seed!r}")
    if seed < 0:
        raise ValueError(f"a seed is an integer of 0 or more, not {seed!r}")
    return int(seed)


def fold_seed(seed: int) -> int:
    """Maps a seed of any size to a seed of a configuration, at most `MAX_SEED`."""
    if seed <= MAX_SEED:
        return seed
    return int(np.random.SeedSequence(seed).generate_state(1, np.uint64)[0]) >> _UNUSED_BITS


def dump_generator(random: np.random.Generator) -> dict[str, Any]:
    """Serializes a generator; 128-bit integers become strings, since JSON readers cannot take them."""
    state: Any = random.bit_generator.state
    words = {name: str(value) for name, value in state["state"].items()}
    return {**state, "state": words}


def load_generator(state: Mapping[str, Any]) -> np.random.Generator:
    """Restores a generator. Raises `ValueError`, `TypeError` or `LookupError` for an invalid state."""
    random = np.random.Generator(np.random.PCG64())
    numbers = {name: int(value) for name, value in state["state"].items()}
    random.bit_generator.state = {**state, "state": numbers}
    return random
