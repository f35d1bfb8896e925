"""When snapshots of sessions are made: rarely, beside everything else, and never waited for.

After a change that makes coming back long, when a session goes to sleep or the service stops, and when one
came back the long way. What it was is taken down at once, which is quick; it is written in a thread and
stored later, one session after the other. Where that fails nobody is told but the log, and that once.
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

from service.sessions.persistence.snapshot_codec import Frozen
from service.sessions.persistence.snapshots import TooLargeError, UnfitError, sealed
from service.sessions.session import Session
from service.settings import Settings
from service.store import SnapshotRecord, Store, StoreError

_LOG = structlog.get_logger(__name__)

CALM_S = 0.25
"""How long is waited before each: what came just before has others to serve."""

WRITTEN = 2
"""One work for so many entries: writing a long log takes as long as that."""

THINGS = 100
"""A road with so many things on it takes twice as long as an empty one."""

MOST_DUE = 64
"""Sessions whose snapshot is waiting to be written: each is held in memory as it was."""

LEFT = 4
"""Of the work after which one is kept, one part of so many is enough where the session is let go of."""

Fate = Literal["kept", "used", "unfit", "failed"]
FATES: tuple[Fate, ...] = ("kept", "used", "unfit", "failed")


class Keeper:
    """Keeps snapshots of the sessions of one service."""

    def __init__(self, store: Store, settings: Settings) -> None:
        self._store = store
        self._work = settings.snapshot_work
        self._lines = settings.log_events
        self._due: dict[str, Frozen] = {}
        self._worker: asyncio.Task[None] | None = None
        self._until_s: float | None = None
        self._hurry = asyncio.Event()
        self._said = False
        self.fates: Counter[Fate] = Counter()
        """what became of snapshots"""

    def join(self, session: Session) -> None:
        """A session is live from now on."""
        session.after_change = self._changed
        footing = session.footing
        if footing.owe(session.timeline.worked, 0) >= self._enough(session):
            self._take(session)

    def fork(self, session: Session) -> None:
        """A session is live from now on, and has no snapshot of what it shares."""
        session.footing.owed = session.timeline.work_since(0)
        session.footing.seen = session.timeline.worked
        self.join(session)

    def leave(self, session: Session) -> None:
        """A session is let go of; where its clock stands is stored."""
        if self._owed(session) * LEFT >= self._enough(session):
            self._take(session)

    def forget(self, session_id: str) -> None:
        """A session is no more."""
        self._due.pop(session_id, None)

    async def find(self, session_id: str) -> SnapshotRecord | None:
        """The snapshot of a session, if there is one that can be had."""
        try:
            return await self._store.snapshot(session_id)
        except StoreError as error:
            self._unfit(session_id, error)
            return None

    def used(self, session_id: str, unfit: UnfitError | None) -> None:
        """A snapshot was used for a session that came back; or it did not fit."""
        if unfit is None:
            self.fates["used"] += 1
        else:
            self._unfit(session_id, unfit)

    async def settled(self) -> None:
        """Keep what is to be kept, now."""
        await self._keep_all(within_s=60.0)
        self._until_s = None
        self._hurry.clear()

    async def close(self, sessions: Iterable[Session], within_s: float) -> None:
        """Keep what there is time for, of those that owe most first. Where clocks stand is stored."""
        self._until_s = time.monotonic() + within_s
        for session in sorted(sessions, key=self._owed, reverse=True):
            self.leave(session)
        await asyncio.wait([asyncio.ensure_future(self._keep_all(within_s))], timeout=2 * within_s)

    async def _keep_all(self, within_s: float) -> None:
        """Keep at once what waits, as far as there is time for it."""
        self._until_s = time.monotonic() + within_s
        self._hurry.set()
        if self._worker is not None:
            await asyncio.wait([self._worker])  # it may be in the midst of one
        await self._keep_due()

    def _owed(self, session: Session) -> int:
        return session.footing.owe(session.timeline.worked, 0)

    def _enough(self, session: Session) -> float:
        """After how much work a snapshot of it is worth its while."""
        world = session.run.world
        slow = 1 + (len(world.movers) + len(world.hazards)) / THINGS
        return max(self._work / slow, len(session.timeline.entries) / WRITTEN)

    def _changed(self, session: Session) -> None:
        if session.footing.owe(session.timeline.worked, 1) >= self._enough(session):
            self._take(session)

    def _take(self, session: Session) -> None:
        if len(self._due) >= MOST_DUE and session.id not in self._due:
            return  # with the next change, or never: it is only a shortcut
        session.footing.owed = 0
        self._due.pop(session.id, None)
        self._due[session.id] = Frozen.of(session)
        if self._worker is None and self._until_s is None:
            self._worker = asyncio.ensure_future(self._keep_in_time())
            self._worker.add_done_callback(self._ended)

    def _ended(self, worker: asyncio.Task[None]) -> None:
        self._worker = None
        if not worker.cancelled() and (error := worker.exception()) is not None:
            self._failed("", error)

    async def _keep_in_time(self) -> None:
        while self._due and self._until_s is None:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._hurry.wait(), CALM_S)
            if self._until_s is None and self._due:
                await self._keep(self._due.pop(next(iter(self._due))))

    async def _keep_due(self) -> None:
        while self._due:
            frozen = self._due.pop(next(iter(self._due)))
            if self._until_s is None or time.monotonic() + _takes_s(frozen) < self._until_s:
                await self._keep(frozen)

    async def _keep(self, frozen: Frozen) -> None:
        try:
            snapshot = await to_thread.run_sync(sealed, frozen, self._lines)
            await self._store.keep_snapshot(snapshot)
        except (StoreError, TooLargeError) as error:
            self._failed(frozen.session, error)
        else:
            self.fates["kept"] += 1
            self._said = False

    def _failed(self, session_id: str, error: BaseException) -> None:
        self.fates["failed"] += 1
        if not self._said:
            self._said = True
            _LOG.warning(
                "a snapshot was not kept; sessions come back the long way",
                session=session_id,
                error=repr(error),
            )

    def _unfit(self, session_id: str, error: Exception) -> None:
        self.fates["unfit"] += 1
        _LOG.info("a snapshot does not fit and is ignored", session=session_id, reason=str(error))


def _takes_s(frozen: Frozen) -> float:
    """About how long one takes to be written and stored."""
    entries = len(frozen.timeline.entries) + len(frozen.history.done)
    return 0.01 + 4e-6 * entries + 1e-4 * len(frozen.timeline.parts()[3])
