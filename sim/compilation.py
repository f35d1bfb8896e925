"""Compiling the project's own text for machine words, and keeping what was compiled.

A function of `sim.rules` or `sim.randomness` is compiled as it stands, with the functions it calls
replaced by their compiled forms, so that there is one copy of every rule. Compiled code is kept
in a folder named by a digest of everything it was made from: the usual check looks only at the file
of the outermost function, and would go on using an old rule that had been compiled into it.

Nothing else imports numba, `numbers` included: two threads that begin to import it in different modules block
each other, and Python breaks that by failing one of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any

import numba
from numba.cpython.unsafe import numbers as numbers

from sim import randomness
from sim.compiled_files import cache_folder

config: Any = numba.config


@contextmanager
def _cached_in(folder: Path) -> Iterator[None]:
    before = config.CACHE_DIR
    config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        config.CACHE_DIR = before


def on_given_arrays(function: Callable[..., Any]) -> Any:
    """A compiled function that makes no arrays, so that references to those it is given are not counted.

    Counting takes longer than a short function with many arrays does by itself.
    """
    return compiled(function, counting=False)


def compiled(function: Callable[..., Any], signature: str | None = None, *, counting: bool = True) -> Any:
    """A function that is compiled when first called and runs without the interpreter lock."""
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "_nrt": counting}
    folder = cache_folder()
    if folder is None:
        return numba.njit(signature, **options)(function)
    with _cached_in(folder):
        return numba.njit(signature, cache=True, **options)(function)


def with_names(function: Callable[..., Any], signature: str | None = None, **names: Any) -> Any:
    """A function of another module, compiled with some of the names it uses standing for others.

    Where a signature is given, all words it computes with are of these types.
    """
    assert isinstance(function, FunctionType)
    twin = FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)
    return compiled(twin, signature)


# With signed words a shift to the right would draw the sign along: hence the signatures.
mix = with_names(randomness.mix, "uint64(uint64)")
word_at = with_names(randomness.word_at, "uint64(uint64, int64)", mix=mix)
fraction = with_names(randomness.fraction, "float64(uint64)")
scaled = with_names(randomness.scaled, "uint64(uint64, uint64)")
