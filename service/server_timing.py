"""How long the parts of a command take, told to whoever asked; what does a part knows of no figures.

The one who begins a command says who is to be told (`told_to`); a part (`part`) that is done on its behalf is
found by the context, also in tasks that were begun meanwhile. Leaves out what is done with the times.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextvars import ContextVar
from typing import Literal

Part = Literal["parse", "apply", "store"]
"""A sentence is made actions; they are tried on a copy; they are kept."""

PARTS: tuple[Part, ...] = ("parse", "apply", "store")

Observer = Callable[[Part, float], None]

_OBSERVER: ContextVar[Observer | None] = ContextVar("observer", default=None)


class told_to:  # noqa: N801 - used like a function
    """Parts that are done within are told to `observer`, in seconds."""

    # A class, as below: a context manager made of a generator takes three times as long, for every command.
    __slots__ = ("_observer", "_token")

    def __init__(self, observer: Observer) -> None:
        self._observer = observer

    def __enter__(self) -> None:
        self._token = _OBSERVER.set(self._observer)

    def __exit__(self, *_: object) -> None:
        _OBSERVER.reset(self._token)


class part:  # noqa: N801 - used like a function
    """A part of a command, also one that fails."""

    __slots__ = ("_began", "_name", "_observer")

    def __init__(self, name: Part) -> None:
        self._name = name
        self._observer = _OBSERVER.get()

    def __enter__(self) -> None:
        if self._observer is not None:
            self._began = time.perf_counter()

    def __exit__(self, *_: object) -> None:
        if self._observer is not None:
            self._observer(self._name, time.perf_counter() - self._began)
