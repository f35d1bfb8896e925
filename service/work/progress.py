"""How far a piece of work is: told by whoever does it, heard by whoever waits for it.

In a worker process the share goes back through the pipe of its answers; in the service it is told to whoever
set `HEARD`. Work that nobody listens to tells it to nobody.
"""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar

Heard = Callable[[float], None]
"""Takes the share that is done, from 0 to 1; called from any thread."""

HEARD: ContextVar[Heard | None] = ContextVar("heard", default=None)
"""Who hears of the work of the request under way."""

_tell_service: Heard | None = None


def tell_through(tell: Heard) -> None:
    """Say how the service hears of it; for a worker process."""
    global _tell_service
    _tell_service = tell


def tell(share: float) -> None:
    """Say how much of the work under way is done."""
    if _tell_service is not None:
        _tell_service(share)
