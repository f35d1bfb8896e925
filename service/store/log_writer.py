"""The log writer: entries that arrive while others are written are committed together (group commit).

They share one wait for the disk, over all sessions, and none is acknowledged before its own commit.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass

from service.store.base import EntryRecord, StoredResponse, StoreError
from service.store.sql_base import LostError


@dataclass(frozen=True, slots=True)
class PendingEntry:
    """An entry of a session that is not committed yet, with the answer that is stored with it."""

    session: str
    entry: EntryRecord
    answer: StoredResponse | None
    done: asyncio.Future[None]


Commit = Callable[[Sequence[PendingEntry]], Awaitable[None]]
"""Commits entries in one transaction, all or none. Raises `StoreError`."""


class LogWriter:
    """Writes entries batch by batch. For the event loop's thread only."""

    def __init__(self, commit: Commit) -> None:
        self._commit = commit
        self._pending: list[PendingEntry] = []
        self._writing: asyncio.Task[None] | None = None

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None) -> None:
        """Join the next commit, and return when it is done. Raises `StoreError`."""
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._pending.append(PendingEntry(session_id, entry, answer, done))
        if self._writing is None:
            self._writing = asyncio.create_task(self._write())
        await done

    async def finish(self) -> None:
        """Wait for the entries that are pending."""
        if self._writing is not None:
            await asyncio.wait((self._writing,))

    async def _write(self) -> None:
        try:
            while self._pending:
                batch, self._pending = self._pending, []
                await self._write_batch(batch)
        finally:
            self._writing = None

    async def _write_batch(self, batch: Sequence[PendingEntry], *, again: bool = True) -> None:
        try:
            await self._commit(batch)
        except StoreError as error:
            if isinstance(error, LostError) and again:
                await self._write_batch(batch, again=False)
            elif len(batch) > 1:
                # One bad entry must not fail its neighbours: each gets its own commit.
                for pending in batch:
                    await self._write_batch([pending], again=False)
            elif not batch[0].done.done():
                batch[0].done.set_exception(error)
        else:
            for pending in batch:
                if not pending.done.done():
                    pending.done.set_result(None)
