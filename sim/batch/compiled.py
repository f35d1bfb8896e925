"""Compiling the rules' own text for machine words, and keeping what was compiled.

A function of `sim.rules` or `sim.randomness` is compiled as it stands, with the functions it calls
replaced by their compiled forms, so that there is one copy of every rule. Compiled code is kept
in a folder named by a digest of everything it was made from: the usual check looks only at the file
of the outermost function, and would go on using an old rule that had been compiled into it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any, Final

import numba
import numpy as np
from numba.cpython.unsafe import numbers

from sim import randomness
from sim.compiled_files import cache_folder
from sim.rules import ego_step, limits, traffic
from sim.rules.mover_boards import PERIODS
from sim.types import Kind

config: Any = numba.config


@contextmanager
def _cached_in(folder: Path) -> Iterator[None]:
    before = config.CACHE_DIR
    config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        config.CACHE_DIR = before


def compiled(function: Callable[..., Any], signature: str | None = None) -> Any:
    """A function that is compiled when first called and runs without the interpreter lock."""
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
    folder = cache_folder()
    if folder is None:
        return numba.njit(signature, **options)(function)
    with _cached_in(folder):
        return numba.njit(signature, cache=True, **options)(function)


def _with_names(function: Callable[..., Any], signature: str | None = None, **names: Any) -> Any:
    """A function of another module, compiled with some of the names it uses standing for others.

    Where a signature is given, all words it computes with are of these types.
    """
    assert isinstance(function, FunctionType)
    twin = FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)
    return compiled(twin, signature)


# With signed words a shift to the right would draw the sign along: hence the signatures.
mix = _with_names(randomness.mix, "uint64(uint64)")
word_at = _with_names(randomness.word_at, "uint64(uint64, int64)", mix=mix)
fraction = _with_names(randomness.fraction, "float64(uint64)")
scaled = _with_names(randomness.scaled, "uint64(uint64, uint64)")

steps_in_tick = _with_names(traffic.steps_in_tick)
move_movers = _with_names(traffic.move_movers)
brake = _with_names(traffic.brake)
followed_board = _with_names(traffic.shift_board)
cut_off = _with_names(ego_step.cut_off)
free_steps = _with_names(ego_step.free_steps)
spread = _with_names(ego_step.spread)
spread_back = _with_names(ego_step.spread_back)
beside = _with_names(ego_step.beside)
max_ticks = _with_names(limits.max_ticks)
steps_left = _with_names(limits.steps_left, max_ticks=max_ticks)


_trailing_zeros: Any = numbers.trailing_zeros


_PEDESTRIAN_PERIOD: Final = PERIODS[Kind.PEDESTRIAN]


@compiled
def pedestrians_walk(episode_tick):
    """Whether pedestrians step in the tick that begins at `episode_tick`."""
    return steps_in_tick(_PEDESTRIAN_PERIOD, episode_tick)


@compiled
def first_bit(word):
    """The number of the lowest bit of a word that has one."""
    return np.int64(_trailing_zeros(word))
