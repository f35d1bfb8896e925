"""How long the parts of a command take, told to whoever asked; what does a part knows of no figures.

The one who begins a command says who is to be told (`told_to`); a part (`part`) that is done on its behalf is
found by the context, also in tasks that were begun meanwhile. Leaves out what is done with the times.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal

Part = Literal["parse", "apply", "store"]
"""A sentence is made actions; they are tried on a copy; they are kept."""

PARTS: tuple[Part, ...] = ("parse", "apply", "store")

Observer = Callable[[Part, float], None]

_OBSERVER: ContextVar[Observer | None] = ContextVar("observer", default=None)


@contextmanager
def told_to(observer: Observer) -> Iterator[None]:
    """Parts that are done within are told to `observer`, in seconds."""
    token = _OBSERVER.set(observer)
    try:
        yield
    finally:
        _OBSERVER.reset(token)


@contextmanager
def part(name: Part) -> Iterator[None]:
    """A part of a command, also one that fails."""
    observer = _OBSERVER.get()
    if observer is None:
        yield
        return
    began = time.perf_counter()
    try:
        yield
    finally:
        observer(name, time.perf_counter() - began)
