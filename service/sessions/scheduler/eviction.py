"""Eviction: drops idle sessions from memory.

A session is wholly stored, so evicting it means storing its tick, and restoring it is what happens after a
restart: the same ids, sequence and digest, paused. A session is evicted when it has no subscriber, was not
asked for in a while, and is paused (a setting evicts running ones too). Transient lines of the log are lost.

Where the limit of live sessions is reached, room is made at once: see `RoomMaker`.
"""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Awaitable, Callable, Iterable

import structlog

from service.sessions.session import Session
from service.store import StoreError

_LOG = structlog.get_logger(__name__)

CHECKS_PER_TIMEOUT = 4
"""Number of checks in the time after which a session is evicted."""


class IdleTimes:
    """When each session was last used, by a monotonic clock."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self.now = now
        self._used_s: dict[str, float] = {}

    def touch(self, session_id: str) -> None:
        """Record that a session is used now."""
        self._used_s[session_id] = self.now()

    def forget(self, session_id: str) -> None:
        """Forget a session that was deleted or evicted."""
        self._used_s.pop(session_id, None)

    def idle_s(self, session: Session) -> float:
        """Seconds since the session was last used; one with subscribers or work under way is in use."""
        if len(session.subscribers) or session.busy:
            self.touch(session.id)
        return self.now() - self._used_s.setdefault(session.id, self.now())


class Evictor:
    """Evicts sessions that have been idle for `after_s`."""

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
        """Whether the session is idle and may be evicted."""
        idle_s = self._idleness.idle_s(session)
        return idle_s >= self._after_s and (session.paused or self._running)

    async def evict_idle(self) -> int:
        """Evict idle sessions once; returns how many."""
        idle = [session for session in self._live() if self.is_evictable(session)]
        return await self._evict(idle, self.is_evictable) if idle else 0

    async def run(self) -> None:
        """Evict idle sessions from time to time, until cancelled."""
        while True:
            await asyncio.sleep(self._after_s / CHECKS_PER_TIMEOUT)
            try:
                await self.evict_idle()
            except StoreError as error:
                _LOG.warning("no session could be put to sleep", error=str(error))


class RoomMaker:
    """Chooses the sessions that leave memory where the limit of live sessions is reached.

    A paused session without subscribers may leave at once, since it comes back as it was; a running one only
    when nobody has asked for it for `after_s`, since it comes back paused.
    """

    def __init__(self, sessions: Iterable[Session], idleness: IdleTimes, after_s: float) -> None:
        self._idleness = idleness
        self._after_s = after_s
        self._idle_s = {each: idleness.idle_s(each) for each in sessions}

    def may_leave(self, session: Session) -> bool:
        """Whether nobody uses the session, now."""
        if len(session.subscribers) or session.busy:
            return False
        return session.paused or self._idleness.idle_s(session) >= self._after_s

    def longest_idle(self, count: int) -> list[Session]:
        """At most so many sessions that may leave, the longest idle first."""
        leaving = [session for session in self._idle_s if self.may_leave(session)]
        return sorted(leaving, key=self._idle_s.__getitem__, reverse=True)[:count]

    def wait_s(self) -> int:
        """Whole seconds after which one of the sessions may leave if nobody asks for it until then."""
        shortest = min((self._after_s - idle_s for idle_s in self._idle_s.values()), default=0.0)
        return max(1, math.ceil(shortest))
