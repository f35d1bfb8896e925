"""Retention: deletes stored sessions that nobody has used for long, where a setting says how long.

Nothing is deleted by default: a road that somebody built is worth more than its few kilobytes, and an upgrade
must not take it away. Sessions with a name or a bookmark are kept unless another setting says otherwise.

When a session was last used is written down when it leaves memory, and every hour for the live ones. Live
sessions never expire. The clock is read once and goes on by a monotonic one, and where no session at all was
used in the period none is deleted: a clock that jumps, or a service that stood still for a year, deletes
nothing.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta

import structlog

from service.sessions.manager import SessionManager
from service.settings import Settings
from service.store import Store, StoreError

_LOG = structlog.get_logger(__name__)

FIRST_S = 300.0
"""From the start of the service to the first sweep."""
INTERVAL_S = 3_600.0
"""From one sweep to the next."""
BATCH = 20
"""Sessions looked up together; each is deleted in a transaction of its own."""
PAUSE_S = 0.1
"""Between two batches, so that others have the store to themselves."""


class Retention:
    """Writes down which sessions are in use, and deletes those that were not for too long."""

    def __init__(
        self,
        store: Store,
        manager: SessionManager,
        settings: Settings,
        expired: Callable[[str], None],
        now: Callable[[], datetime] | None = None,
    ) -> None:
        """`expired`: told of each session that was deleted."""
        self._store = store
        self._manager = manager
        self._days = settings.keep_sessions_days
        self._named = not settings.keep_named_sessions
        self._expired = expired
        self._now = now or _steady_clock()

    async def sweep(self) -> int:
        """Write down what is in use and delete what was not; returns how many. Raises `StoreError`."""
        now = self._now()
        await self._store.touch(list(self._manager.live_sessions), now)
        if self._days is None:
            return 0
        since, deleted, looked_up = now - timedelta(days=self._days), 0, BATCH
        while batch := await self._store.unused(since, looked_up, named=self._named):
            mine = [each for each in batch if self._manager.owns(each)]
            gone = [each for each in mine if await self._manager.expire(each)]
            for each in gone:
                self._expired(each)
            deleted += len(gone)
            if len(gone) < len(mine):
                break  # somebody uses one of them just now: the next sweep looks again
            if not mine:
                if len(batch) < looked_up:
                    break  # the rest is for other shards to delete
                looked_up *= 2
            await asyncio.sleep(PAUSE_S)
        if deleted:
            _LOG.info("retention", count=deleted, days=self._days)
        return deleted

    async def run(self) -> None:
        """Sweep from time to time, until cancelled."""
        delay_s = FIRST_S
        while True:
            await asyncio.sleep(delay_s)
            delay_s = INTERVAL_S
            try:
                await self.sweep()
            except StoreError as error:
                _LOG.warning("retention_failed", error=str(error))


def _steady_clock() -> Callable[[], datetime]:
    """The time of now, which goes on evenly whatever happens to the machine's clock."""
    start, began_s = datetime.now(UTC), time.monotonic()
    return lambda: start + timedelta(seconds=time.monotonic() - began_s)
