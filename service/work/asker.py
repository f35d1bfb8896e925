"""Who asks for work: the client it counts for, and how it is known that nobody waits for the answer any more.

The HTTP and WebSocket layers set it for the request under way; work in worker processes reads it.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Asker:
    """One client that waits for an answer."""

    client: str
    gone: Callable[[], Awaitable[object]] | None = None
    """returns once the client has hung up; None where that cannot be known"""


NOBODY = Asker("")
"""For work that the service does of itself: it counts for no client and is never cancelled."""

CURRENT_ASKER: ContextVar[Asker] = ContextVar("current_asker", default=NOBODY)


@contextmanager
def of_nobody() -> Iterator[None]:
    """Tasks begun here are the service's own, whoever asked first."""
    token = CURRENT_ASKER.set(NOBODY)
    try:
        yield
    finally:
        CURRENT_ASKER.reset(token)
