"""The snapshot scheduler: decides when to take snapshots, and saves them in the background.

A snapshot is taken after a change that makes a restore slow, when a session is evicted, when the service
stops, and when a session was restored without one. Taking it is quick; it is encoded in a thread and stored
later, one session after another. A failure is logged once and affects restore time only.
"""

from __future__ import annotations

import asyncio
import time
from collections import Counter
from collections.abc import Iterable
from contextlib import suppress
from typing import Literal

import structlog
from anyio import to_thread

from service.sessions.persistence.session_snapshot import SessionSnapshot
from service.sessions.persistence.snapshot_records import TooLargeError, UnfitError, pack
from service.sessions.session import Session
from service.settings import Settings
from service.store import SnapshotRecord, Store, StoreError

_LOG = structlog.get_logger(__name__)

DELAY_S = 0.25
"""Pause before each snapshot, so that requests go first."""

ENTRIES_PER_WORK = 2
"""Encoding so many entries of a log takes as long as one tick of work."""

THINGS_PER_DOUBLING = 100
"""A road with so many things takes twice as long to simulate as an empty one."""

MAX_DUE = 64
"""Largest number of pending snapshots, each of which holds a session in memory."""

REMOVE_FRACTION = 4
"""At an eviction, this fraction of the interval is enough for a snapshot (one in so many)."""

SnapshotResult = Literal["kept", "used", "unfit", "failed"]
SNAPSHOT_RESULTS: tuple[SnapshotResult, ...] = ("kept", "used", "unfit", "failed")


class SnapshotScheduler:
    """Takes and saves snapshots of the sessions of one service."""

    def __init__(self, store: Store, settings: Settings) -> None:
        self._store = store
        self._interval = settings.snapshot_work
        self._lines = settings.log_events
        self._due: dict[str, SessionSnapshot] = {}
        self._worker: asyncio.Task[None] | None = None
        self._until_s: float | None = None
        self._hurry = asyncio.Event()
        self._said = False
        self.counts: Counter[SnapshotResult] = Counter()
        """snapshots by result"""

    def add(self, session: Session) -> None:
        """Begin to watch a live session."""
        session.after_change = self._on_change
        position = session.log_position
        if position.add_work(session.timeline.worked, 0) >= self._interval_of(session):
            self.take(session)

    def add_fork(self, session: Session) -> None:
        """Begin to watch a fork, which has no snapshot of the part that it shares."""
        session.log_position.work = session.timeline.work_since(0)
        session.log_position.counted_work = session.timeline.worked
        self.add(session)

    def remove(self, session: Session) -> None:
        """Take a last snapshot of an evicted session, if its restore would take long."""
        if self._work_of(session) * REMOVE_FRACTION >= self._interval_of(session):
            self.take(session)

    def forget(self, session_id: str) -> None:
        """Drop the pending snapshot of a deleted session."""
        self._due.pop(session_id, None)

    async def find(self, session_id: str) -> SnapshotRecord | None:
        """The stored snapshot of a session, if there is one that can be read."""
        try:
            return await self._store.snapshot(session_id)
        except StoreError as error:
            self._record_unfit(session_id, error)
            return None

    def record_use(self, session_id: str, unfit: UnfitError | None) -> None:
        """Count a snapshot as used, or as unfit with the reason."""
        if unfit is None:
            self.counts["used"] += 1
        else:
            self._record_unfit(session_id, unfit)

    async def flush(self) -> None:
        """Save all pending snapshots now."""
        await self._save_all(within_s=60.0)
        self._until_s = None
        self._hurry.clear()

    async def close(self, sessions: Iterable[Session], within_s: float) -> None:
        """Save what there is time for, sessions with the most work first. Their ticks are stored already."""
        self._until_s = time.monotonic() + within_s
        for session in sorted(sessions, key=self._work_of, reverse=True):
            self.remove(session)
        await asyncio.wait([asyncio.ensure_future(self._save_all(within_s))], timeout=2 * within_s)

    async def _save_all(self, within_s: float) -> None:
        """Save pending snapshots at once, within a time."""
        self._until_s = time.monotonic() + within_s
        self._hurry.set()
        if self._worker is not None:
            await asyncio.wait([self._worker])  # it may be in the midst of one
        await self._save_due()

    def _work_of(self, session: Session) -> int:
        return session.log_position.add_work(session.timeline.worked, 0)

    def _interval_of(self, session: Session) -> float:
        """The work after which a snapshot of a session pays."""
        world = session.run.world
        slow = 1 + (len(world.movers) + len(world.hazards)) / THINGS_PER_DOUBLING
        return max(self._interval / slow, len(session.timeline.entries) / ENTRIES_PER_WORK)

    def _on_change(self, session: Session) -> None:
        if session.log_position.add_work(session.timeline.worked, 1) >= self._interval_of(session):
            self.take(session)

    def take(self, session: Session) -> None:
        """Take a snapshot now and queue it to be saved, unless the queue is full."""
        if len(self._due) >= MAX_DUE and session.id not in self._due:
            return  # with the next change, or never: it is only a shortcut
        session.log_position.work = 0
        self._due.pop(session.id, None)
        self._due[session.id] = SessionSnapshot.take(session)
        if self._worker is None and self._until_s is None:
            self._worker = asyncio.ensure_future(self._save_in_background())
            self._worker.add_done_callback(self._worker_ended)

    def _worker_ended(self, worker: asyncio.Task[None]) -> None:
        self._worker = None
        if not worker.cancelled() and (error := worker.exception()) is not None:
            self._record_failure("", error)

    async def _save_in_background(self) -> None:
        while self._due and self._until_s is None:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._hurry.wait(), DELAY_S)
            if self._until_s is None and self._due:
                await self._save(self._due.pop(next(iter(self._due))))

    async def _save_due(self) -> None:
        while self._due:
            frozen = self._due.pop(next(iter(self._due)))
            if self._until_s is None or time.monotonic() + _estimate_s(frozen) < self._until_s:
                await self._save(frozen)

    async def _save(self, frozen: SessionSnapshot) -> None:
        try:
            snapshot = await to_thread.run_sync(pack, frozen, self._lines)
            await self._store.save_snapshot(snapshot)
        except (StoreError, TooLargeError) as error:
            self._record_failure(frozen.session, error)
        else:
            self.counts["kept"] += 1
            self._said = False

    def _record_failure(self, session_id: str, error: BaseException) -> None:
        self.counts["failed"] += 1
        if not self._said:
            self._said = True
            _LOG.warning(
                "a snapshot was not kept; sessions come back the long way",
                session=session_id,
                error=repr(error),
            )

    def _record_unfit(self, session_id: str, error: Exception) -> None:
        self.counts["unfit"] += 1
        _LOG.info("a snapshot does not fit and is ignored", session=session_id, reason=str(error))


def _estimate_s(frozen: SessionSnapshot) -> float:
    """The estimated time to encode and store a snapshot, in seconds."""
    entries = len(frozen.timeline.entries) + len(frozen.undo_stack.done)
    return 0.01 + 4e-6 * entries + 1e-4 * len(frozen.timeline.parts()[3])
