"""Sessions that nobody needs sleep: they are let go from memory, and come back when they are asked for.

All that a session is stands in the store, so letting go is to remember where its clock stood, and waking
is what happens after a restart: the same ids, sequence and digest, paused. It befalls sessions that are
paused (or running too, where the setting says so), that nobody watches, and that nobody has asked for
in a while. Leaves out lines of the log that no entry made: they are forgotten.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Iterable

import structlog

from service.sessions.session import Session
from service.store import StoreError

_LOG = structlog.get_logger(__name__)

CHECKS_PER_TIMEOUT = 4
"""How often it is looked in the time after which a session sleeps."""


class IdleTimes:
    """When each session was last asked for, by a clock that never runs backwards."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self.now = now
        self._used_s: dict[str, float] = {}

    def touch(self, session_id: str) -> None:
        """It was asked for just now."""
        self._used_s[session_id] = self.now()

    def forget(self, session_id: str) -> None:
        """It is no more, or asleep."""
        self._used_s.pop(session_id, None)

    def idle_s(self, session: Session) -> float:
        """How long nobody has needed it; whoever watches or is being answered does."""
        if len(session.subscribers) or session.busy:
            self.touch(session.id)
        return self.now() - self._used_s.setdefault(session.id, self.now())


class Evictor:
    """Puts sessions to sleep that have been idle for `after_s`."""

    def __init__(
        self,
        live: Callable[[], Iterable[Session]],
        let_go: Callable[[list[Session], Callable[[Session], bool]], Awaitable[int]],
        idleness: IdleTimes,
        *,
        after_s: float,
        running: bool,
    ) -> None:
        """`let_go`: given the sessions, and whether one of them may still be let go once it is stored."""
        self._live = live
        self._evict = let_go
        self._idleness = idleness
        self._after_s = after_s
        self._running = running

    def is_evictable(self, session: Session) -> bool:
        """Whether nobody would miss it."""
        idle_s = self._idleness.idle_s(session)
        return idle_s >= self._after_s and (session.paused or self._running)

    async def evict_idle(self) -> int:
        """Look once; how many went to sleep."""
        idle = [session for session in self._live() if self.is_evictable(session)]
        return await self._evict(idle, self.is_evictable) if idle else 0

    async def run(self) -> None:
        """Look every now and then, until cancelled."""
        while True:
            await asyncio.sleep(self._after_s / CHECKS_PER_TIMEOUT)
            try:
                await self.evict_idle()
            except StoreError as error:
                _LOG.warning("no session could be put to sleep", error=str(error))
