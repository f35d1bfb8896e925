"""Compiling the project's own text for machine words, and keeping what was compiled.

A function of `sim.rules` or `sim.randomness` is compiled as it stands, with the functions it calls
replaced by their compiled forms, so that there is one copy of every rule. Compiled code is kept
in a folder named by a digest of everything it was made from: the usual check looks only at the file
of the outermost function, and would go on using an old rule that had been compiled into it.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from hashlib import blake2b
from pathlib import Path
from types import FunctionType
from typing import Any, Final

import numba

from sim import randomness

config: Any = numba.config

_SIM: Final = Path(__file__).parent
_COMPILED_IN: Final = tuple(
    _SIM / name
    for name in (
        "rules/ego_step.py",
        "rules/mover_boards.py",
        "rules/limits.py",
        "rules/traffic.py",
        "randomness.py",
        "generation.py",
        "types.py",
        "compilation.py",
        "perceive/belief.py",
        "perceive/log_odds.py",
        "perceive/look.py",
        "perceive/occlusion.py",
        "perceive/percept.py",
    )
)
"""Sources outside the folders of kernels whose functions or constants are compiled."""
_KERNELS: Final = ("batch", "perceive/kernel")
_KEPT_VERSIONS: Final = 3


@cache
def cache_folder() -> Path | None:
    """Where compiled code of exactly these sources is kept; None if nothing can be written."""
    digest = blake2b(numba.__version__.encode(), digest_size=8)
    kernels = [path for folder in _KERNELS for path in sorted((_SIM / folder).glob("*.py"))]
    for source in (*_COMPILED_IN, *kernels):
        digest.update(source.read_bytes())
    home = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "roadtalk" / "compiled"
    folder = Path(os.environ.get("NUMBA_CACHE_DIR") or home) / digest.hexdigest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".used").touch()
        _forget_old(folder.parent)
    except OSError:
        return None
    return folder


def _forget_old(folder: Path) -> None:
    versions = sorted(folder.glob("*/.used"), key=lambda mark: mark.stat().st_mtime, reverse=True)
    for mark in versions[_KEPT_VERSIONS:]:
        shutil.rmtree(mark.parent, ignore_errors=True)


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
