"""Seeds as Gymnasium takes them, and the state of a random generator as a JSON value.

A seed up to 2⁵³ − 1 is the seed of the road's configuration as it is. A larger one is folded: its road is
that of the 53 highest bits of the first 64-bit word that `numpy.random.SeedSequence` makes of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Integral
from typing import Any, Final

import numpy as np

from sim.randomness import MAX_SEED

DRAWN_BELOW: Final = 2**32
"""Seeds that nobody gave are drawn below this."""

_UNUSED_BITS: Final = 64 - MAX_SEED.bit_length()


def check_seed(seed: object) -> int:
    """A seed as a Python integer. Raises `TypeError` unless it is an integer, `ValueError` if negative."""
    if isinstance(seed, bool | np.bool_) or not isinstance(seed, Integral):
        raise TypeError(f"a seed is an integer of 0 or more, not {seed!r}")
    if seed < 0:
        raise ValueError(f"a seed is an integer of 0 or more, not {seed!r}")
    return int(seed)


def fold_seed(seed: int) -> int:
    """The seed of a configuration that a seed stands for."""
    if seed <= MAX_SEED:
        return seed
    return int(np.random.SeedSequence(seed).generate_state(1, np.uint64)[0]) >> _UNUSED_BITS


def dump_generator(random: np.random.Generator) -> dict[str, Any]:
    """The state of a generator; numbers of 128 bits as words, since JSON readers take no such numbers."""
    state: Any = random.bit_generator.state
    words = {name: str(value) for name, value in state["state"].items()}
    return {**state, "state": words}


def load_generator(state: Mapping[str, Any]) -> np.random.Generator:
    """The generator of a state. Raises `ValueError`, `TypeError` or `LookupError` for what is none."""
    random = np.random.Generator(np.random.PCG64())
    numbers = {name: int(value) for name, value in state["state"].items()}
    random.bit_generator.state = {**state, "state": numbers}
    return random
