"""Tickets: good for one socket and a few seconds, so that a page need not hand its key to every socket."""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable

GOOD_FOR_S = 30
MOST = 10_000
"""Tickets that may be out at once; the oldest goes first."""


class Tickets:
    """The tickets that are out; kept in memory, since none outlives half a minute."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._until: dict[str, float] = {}

    def issue(self) -> str:
        """A new ticket."""
        self._forget()
        while len(self._until) >= MOST:
            del self._until[next(iter(self._until))]
        ticket = secrets.token_urlsafe(32)
        self._until[ticket] = self._now() + GOOD_FOR_S
        return ticket

    def take(self, ticket: str) -> bool:
        """Whether it is good; from now on it is not."""
        return self._until.pop(ticket, 0.0) > self._now()

    def _forget(self) -> None:
        """All are good for the same time, so the first in are the first to go."""
        now = self._now()
        while self._until and self._until[first := next(iter(self._until))] <= now:
            del self._until[first]
