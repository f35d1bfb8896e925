"""Answers kept under idempotency keys, and the requests under way.

Answers are kept for a day. The day is counted from the wall clock at start, by a clock that cannot be set;
while the service is stopped nothing grows old. So no jump of the wall clock forgets a key too early, or
keeps it for ever.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

import structlog

from service.store import Store, StoredResponse, StoreError

_LOG = structlog.get_logger(__name__)

KEPT_S = 24 * 3_600
FORGET_EVERY_S = 3_600


class KeptAnswers:
    """The answers of one service."""

    def __init__(
        self,
        store: Store,
        wall: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self._store = store
        self._wall = wall
        self._steady = steady
        self._began = wall() - steady()
        self._forgot_at = 0
        self._turns: dict[str, tuple[asyncio.Lock, int]] = {}

    @property
    def now(self) -> int:
        """Seconds since 1970 by a clock that cannot be set."""
        return int(self._began + self._steady())

    async def open(self) -> None:
        """Starts the clock at the wall clock; kept answers are as old as when the service stopped."""
        self._began = self._wall() - self._steady()
        await self._store.shift_responses(self.now)
        await self._forget()

    @asynccontextmanager
    async def turn(self, key: str) -> AsyncIterator[None]:
        """Lets one request at a time in under a key."""
        lock, waiting = self._turns.get(key, (asyncio.Lock(), 0))
        self._turns[key] = (lock, waiting + 1)
        try:
            async with lock:
                yield
        finally:
            lock, waiting = self._turns[key]
            if waiting == 1:
                del self._turns[key]
            else:
                self._turns[key] = (lock, waiting - 1)

    async def find(self, key: str) -> StoredResponse | None:
        """The answer that was given under a key within the last day."""
        if self.now - self._forgot_at > FORGET_EVERY_S:
            await self._forget()
        found = await self._store.get_response(key)
        if found is not None and found.at < self.now - KEPT_S:
            await self._forget()
            return None
        return found

    async def keep(self, answer: StoredResponse) -> None:
        """Keeps the answer to a request that left nothing in any session, or that is stored already."""
        try:
            await self._store.save_response(answer)
        except StoreError as error:
            _LOG.error("an answer was not kept", error=str(error))

    async def _forget(self) -> None:
        self._forgot_at = self.now
        await self._store.delete_responses(self.now - KEPT_S)
