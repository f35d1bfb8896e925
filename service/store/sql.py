"""The SQL store, by SQLAlchemy Core: a SQLite file by default, PostgreSQL by URL.

It uses one connection in one process; `engines` says how, and refuses a second service on the same database.
Entries are committed by `log_writer`, many sessions together.

When a server is lost during a commit, the commit may have happened. It is tried once more; if that fails as
well, the caller gets an error, and what may have been committed is deleted with the next transaction.
"""

from __future__ import annotations

import asyncio
import shutil
import sqlite3
import threading
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Final

from anyio import to_thread
from sqlalchemy import delete, insert
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.ext.asyncio import AsyncConnection, AsyncEngine

from service.sharding import SINGLE, Shard
from service.store.base import EntryRecord, StoredResponse, StoreError
from service.store.engines import Postgres, Sqlite, database_for, driver_message
from service.store.log_writer import LogWriter, PendingEntry
from service.store.rows import response_to_row
from service.store.schema import migrate
from service.store.sql_base import LostError, insert_entries
from service.store.sql_jobs import SqlJobs
from service.store.sql_phrases import SqlPhrases
from service.store.sql_responses import SqlResponses
from service.store.sql_sessions import SqlSessions
from service.store.sqlite_log import EntryRows
from service.store.tables import ENTRIES, IDEMPOTENCY
from service.whole_file import remove_partial

TURN_S: Final = 30.0
"""Time to wait for the connection while others use it."""


class SqlStore(SqlSessions, SqlResponses, SqlPhrases, SqlJobs):
    """A `Store` in the database of a URL (`sqlite:///roadtalk.db`, `postgresql://host/name`)."""

    def __init__(self, url: str, shard: Shard = SINGLE) -> None:
        """Raises `StoreError` where the database's driver is not installed."""
        super().__init__()
        self._kind: Sqlite | Postgres = database_for(url, shard)
        self._engine: AsyncEngine | None = None
        self._turn = asyncio.Lock()
        """held by whoever uses the connection"""
        self._log = LogWriter(self._commit_entries)
        self._backups: set[asyncio.Task[None]] = set()
        self._stopped = threading.Event()
        """set when the store closes: a backup ends at its next step"""

    async def open(self) -> None:
        """Open the database, creating or upgrading its tables. Raises `StoreError`."""
        if self._engine is not None:
            return
        await self._kind.check()
        engine = self._kind.engine()
        try:
            async with engine.connect() as connection:
                await connection.run_sync(migrate, self._kind.name)
                await connection.commit()
        except (SQLAlchemyError, OSError, ValueError, StoreError) as error:
            await engine.dispose()
            if isinstance(error, StoreError):
                raise
            raise StoreError(f"{self._kind.name} cannot be opened: {driver_message(error)}") from error
        if isinstance(self._kind, Sqlite):
            await to_thread.run_sync(remove_partial, self._kind.path)
        self._engine = engine
        self._stopped.clear()

    async def close(self) -> None:
        """Finish pending writes and close the database."""
        self._stopped.set()
        if self._backups:
            await asyncio.wait(self._backups)
        await self._log.finish()
        if self._engine is not None:
            await self._engine.dispose()
            self._engine = None

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None) -> None:
        """See `Store.append`; joins the next group commit."""
        if session_id in self.unseen:
            raise StoreError(f"no session {session_id}")
        await self._log.append(session_id, entry, answer)

    async def room(self) -> int | None:
        """See `Store.room`."""
        if not isinstance(self._kind, Sqlite):
            return None
        try:
            return shutil.disk_usage(self._kind.path.resolve().parent).free
        except OSError:
            return None

    async def backup(self, target: Path) -> None:
        """See `Store.backup`."""
        if self._engine is None:
            raise StoreError("The database is not open")
        copying = asyncio.ensure_future(self._kind.copy_open(target, self._stopped))
        self._backups.add(copying)
        copying.add_done_callback(self._backups.discard)
        try:
            await asyncio.shield(copying)
        except (SQLAlchemyError, sqlite3.Error, OSError, ValueError) as error:
            raise StoreError(f"no backup could be made: {driver_message(error)}") from error

    async def _commit_entries(self, batch: Sequence[PendingEntry]) -> None:
        """Commit entries of any sessions in one transaction. Raises `StoreError`."""
        if isinstance(self._kind, Sqlite) and not self._uncertain and self._engine is not None:
            async with self._alone():
                try:
                    if await self._kind.run(EntryRows.of(batch).write):
                        return
                except (sqlite3.Error, OSError) as error:
                    raise StoreError(driver_message(error)) from error
        answers = [each.answer for each in batch if each.answer is not None]
        try:
            async with self._transaction() as connection:
                await insert_entries(connection, [(each.session, each.entry) for each in batch])
                if answers:
                    await connection.execute(insert(IDEMPOTENCY), [response_to_row(each) for each in answers])
        except LostError:
            for each in batch:
                mine = (ENTRIES.c.session_id == each.session, ENTRIES.c.sequence == each.entry.sequence)
                self._uncertain.append(delete(ENTRIES).where(*mine))
            self._mark_uncertain(*answers)
            raise

    @asynccontextmanager
    async def _alone(self) -> AsyncIterator[None]:
        """Have the connection to oneself. Raises `StoreError`."""
        try:
            async with asyncio.timeout(TURN_S):
                await self._turn.acquire()
        except TimeoutError:
            raise StoreError(f"the database has been in use for {TURN_S:g} s") from None
        try:
            yield
        finally:
            self._turn.release()

    @asynccontextmanager
    async def _transaction(self) -> AsyncIterator[AsyncConnection]:
        if self._engine is None:
            raise StoreError("The database is not open")
        async with self._alone():
            try:
                async with self._engine.begin() as connection:
                    doubtful = len(self._uncertain)
                    for statement in self._uncertain[:doubtful]:
                        await connection.execute(statement)
                    yield connection
                del self._uncertain[:doubtful]
            except (SQLAlchemyError, OSError) as error:
                lost = isinstance(error, OSError) or (
                    isinstance(error, DBAPIError) and error.connection_invalidated
                )
                raise (LostError if lost else StoreError)(driver_message(error)) from error
            except ValueError as error:
                # Reading JSON: the file was damaged in a place that its own structure does not show.
                raise StoreError(f"what is kept cannot be read: {error}") from error
