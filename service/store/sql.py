"""The SQL store, by SQLAlchemy Core: a SQLite file by default, PostgreSQL by URL.

It uses one connection in one process; `engines` says how, and refuses a second service on the same database.

Entries that arrive while others are written are committed together (group commit): they share one wait for
the disk, and none is acknowledged before its own commit.

When a server is lost during a commit, the commit may have happened. It is tried once more; if that fails as
well, the caller gets an error, and what may have been committed is deleted with the next transaction.
"""

from __future__ import annotations

import asyncio
import secrets
import sqlite3
import threading
from collections.abc import AsyncIterator, Collection, Mapping, Sequence
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from pathlib import Path

from anyio import to_thread
from sqlalchemy import Delete, bindparam, delete, func, insert, select, update
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.ext.asyncio import AsyncConnection, AsyncEngine

from service.store.base import (
    SECRET_BYTES,
    BookmarkRecord,
    Branch,
    EntryRecord,
    PhraseRecord,
    SessionRecord,
    SnapshotRecord,
    StoredResponse,
    StoreError,
)
from service.store.engines import Postgres, Sqlite, database_for, driver_message
from service.store.fork_log import join_logs
from service.store.rows import (
    bookmarks_to_rows,
    entry_from_row,
    entry_to_row,
    phrase_to_row,
    response_to_row,
    session_from_row,
    session_to_row,
    snapshot_from_row,
    snapshot_to_row,
)
from service.store.schema import migrate
from service.store.sql_jobs import SqlJobs
from service.store.tables import ENTRIES, IDEMPOTENCY, MOMENTS, PHRASES, SECRETS, SESSIONS, SNAPSHOTS
from service.whole_file import remove_partial

_PAGE = 500
"""Entries in a page: making records of rows blocks the event loop."""

_Pending = tuple[str, EntryRecord, StoredResponse | None, "asyncio.Future[None]"]


class _LostError(StoreError):
    """The server is gone or does not answer: the transaction may have been committed."""


class SqlStore(SqlJobs):
    """A `Store` in the database of a URL (`sqlite:///roadtalk.db`, `postgresql://host/name`)."""

    def __init__(self, url: str) -> None:
        """Raises `StoreError` where the database's driver is not installed."""
        self._kind: Sqlite | Postgres = database_for(url)
        self._engine: AsyncEngine | None = None
        self._pending: list[_Pending] = []
        self._writer: asyncio.Task[None] | None = None
        self._unseen: set[str] = set()
        """sessions deleted by this process, whose forks may still have their entries"""
        self._uncertain: list[Delete] = []
        """deletes rows that were not acknowledged and may have been committed"""
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
        under_way = [*self._backups, *([self._writer] if self._writer is not None else [])]
        if under_way:
            await asyncio.wait(under_way)
        if self._engine is not None:
            await self._engine.dispose()
            self._engine = None

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: StoredResponse | None = None
    ) -> SessionRecord:
        """See `Store.create`."""
        try:
            return await self._create(record, entries, answer)
        except _LostError:
            self._uncertain.append(delete(SESSIONS).where(SESSIONS.c.id == record.id))
            self._mark_uncertain(answer)
            raise

    async def _create(
        self, record: SessionRecord, entries: Sequence[EntryRecord], answer: StoredResponse | None
    ) -> SessionRecord:
        async with self._transaction() as connection:
            if record.branch is not None:
                there = select(SESSIONS.c.number).where(SESSIONS.c.id == record.branch.parent)
                if (await connection.execute(there)).one_or_none() is None:
                    raise StoreError(f"no session {record.branch.parent}")
            number = (
                await connection.execute(
                    insert(SESSIONS).returning(SESSIONS.c.number), session_to_row(record)
                )
            ).scalar_one()
            await _insert(connection, [(record.id, entry) for entry in entries])
            if answer is not None:
                await connection.execute(insert(IDEMPOTENCY), response_to_row(answer))
        return record.with_number(number)

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None) -> None:
        """See `Store.append`; joins the next group commit."""
        if session_id in self._unseen:
            raise StoreError(f"no session {session_id}")
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._pending.append((session_id, entry, answer, done))
        if self._writer is None:
            self._writer = asyncio.create_task(self._write())
        await done

    async def get(self, session_id: str) -> SessionRecord | None:
        """See `Store.get`."""
        async with self._transaction() as connection:
            row = (
                await connection.execute(
                    select(SESSIONS).where(SESSIONS.c.id == session_id, ~SESSIONS.c.unseen)
                )
            ).one_or_none()
        return None if row is None else session_from_row(row)

    async def entries(self, session_id: str) -> Sequence[EntryRecord]:
        """See `Store.entries`."""
        line: list[tuple[Branch | None, list[EntryRecord]]] = []
        async with self._transaction() as connection:
            of: str | None = session_id
            most: int | None = None
            while of is not None:
                row = (await connection.execute(select(SESSIONS).where(SESSIONS.c.id == of))).one_or_none()
                if row is None or (row.unseen and of == session_id):
                    return []
                branch = session_from_row(row).branch
                line.append((branch, await _own_entries(connection, of, most)))
                of, most = (branch.parent, branch.sequence) if branch is not None else (None, None)
        return join_logs(reversed(line))

    async def newest(self, limit: int, before: int | None = None) -> Sequence[SessionRecord]:
        """See `Store.newest`."""
        query = select(SESSIONS).where(~SESSIONS.c.unseen).order_by(SESSIONS.c.number.desc()).limit(limit)
        if before is not None:
            query = query.where(SESSIONS.c.number < before)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [session_from_row(row) for row in rows]

    async def count(self) -> int:
        """See `Store.count`."""
        query = select(func.count()).select_from(SESSIONS).where(~SESSIONS.c.unseen)
        async with self._transaction() as connection:
            return int((await connection.execute(query)).scalar_one())

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        """See `Store.save_ticks`."""
        if not ticks:
            return
        used = datetime.now(UTC).replace(tzinfo=None)
        change = update(SESSIONS).where(SESSIONS.c.id == bindparam("of"))
        change = change.values(tick=bindparam("at"), used_at=used)
        async with self._transaction() as connection:
            await connection.execute(change, [{"of": of, "at": at} for of, at in ticks.items()])

    async def touch(self, session_ids: Collection[str], at: datetime) -> None:
        """See `Store.touch`."""
        if not session_ids:
            return
        change = update(SESSIONS).where(SESSIONS.c.id == bindparam("of")).values(used_at=_utc(at))
        async with self._transaction() as connection:
            await connection.execute(change, [{"of": each} for each in session_ids])

    async def unused(self, since: datetime, limit: int, *, named: bool) -> Sequence[str]:
        """See `Store.unused`."""
        query = select(SESSIONS.c.id).where(~SESSIONS.c.unseen, SESSIONS.c.used_at < _utc(since))
        if not named:
            bookmarked = select(MOMENTS.c.number).where(MOMENTS.c.session_id == SESSIONS.c.id).exists()
            query = query.where(SESSIONS.c.name.is_(None), ~bookmarked)
        latest = select(func.max(SESSIONS.c.used_at))
        async with self._transaction() as connection:
            used = (await connection.execute(latest)).scalar_one()
            if used is None or used < _utc(since):
                return []
            rows = await connection.execute(query.order_by(SESSIONS.c.used_at).limit(limit))
            return list(rows.scalars())

    async def delete(self, session_id: str) -> bool:
        """See `Store.delete`."""
        seen = update(SESSIONS).where(SESSIONS.c.id == session_id, ~SESSIONS.c.unseen)
        async with self._transaction() as connection:
            if (await connection.execute(seen.values(unseen=True))).rowcount == 0:
                return False
            for table in (MOMENTS, SNAPSHOTS):
                await connection.execute(delete(table).where(table.c.session_id == session_id))
            of: str | None = session_id
            while of is not None:  # those of its parents as well that were kept for it alone
                forks = select(SESSIONS.c.number).where(SESSIONS.c.parent == of).exists()
                gone = delete(SESSIONS).where(SESSIONS.c.id == of, SESSIONS.c.unseen, ~forks)
                row = (await connection.execute(gone.returning(SESSIONS.c.parent))).one_or_none()
                of = None if row is None else row.parent
        self._unseen.add(session_id)
        return True

    async def save_snapshot(self, record: SnapshotRecord) -> None:
        """See `Store.save_snapshot`."""
        there = select(SESSIONS.c.number).where(SESSIONS.c.id == record.session, ~SESSIONS.c.unseen)
        async with self._transaction() as connection:
            if (await connection.execute(there)).one_or_none() is not None:
                await connection.execute(delete(SNAPSHOTS).where(SNAPSHOTS.c.session_id == record.session))
                await connection.execute(insert(SNAPSHOTS), snapshot_to_row(record))

    async def snapshot(self, session_id: str) -> SnapshotRecord | None:
        """See `Store.snapshot`."""
        query = select(SNAPSHOTS).where(SNAPSHOTS.c.session_id == session_id)
        async with self._transaction() as connection:
            row = (await connection.execute(query)).one_or_none()
        return None if row is None else snapshot_from_row(row)

    async def bookmarks(
        self, limit: int, before: int | None = None, name: str | None = None
    ) -> Sequence[BookmarkRecord]:
        """See `Store.bookmarks`."""
        query = select(MOMENTS, SESSIONS.c.name.label("session_name")).join(SESSIONS)
        if before is not None:
            query = query.where(MOMENTS.c.number < before)
        if name is not None:
            query = query.where(MOMENTS.c.name == name)
        async with self._transaction() as connection:
            rows = (await connection.execute(query.order_by(MOMENTS.c.number.desc()).limit(limit))).all()
        return [
            BookmarkRecord(
                session=row.session_id,
                session_name=row.session_name,
                name=row.name,
                sequence=row.sequence,
                tick=row.tick,
                number=row.number,
            )
            for row in rows
        ]

    async def save_response(self, answer: StoredResponse) -> None:
        """See `Store.save_response`."""
        async with self._transaction() as connection:
            await connection.execute(insert(IDEMPOTENCY), response_to_row(answer))

    async def get_response(self, key: str) -> StoredResponse | None:
        """See `Store.get_response`."""
        async with self._transaction() as connection:
            row = (
                await connection.execute(select(IDEMPOTENCY).where(IDEMPOTENCY.c.key == key))
            ).one_or_none()
        return None if row is None else StoredResponse(**row._mapping)

    async def delete_responses(self, before: int) -> None:
        """See `Store.delete_responses`."""
        async with self._transaction() as connection:
            await connection.execute(delete(IDEMPOTENCY).where(IDEMPOTENCY.c.at < before))

    async def shift_responses(self, newest: int) -> None:
        """See `Store.shift_responses`."""
        async with self._transaction() as connection:
            latest = (await connection.execute(select(func.max(IDEMPOTENCY.c.at)))).scalar_one()
            if latest is not None and latest != newest:
                moved = IDEMPOTENCY.c.at + (newest - latest)
                await connection.execute(update(IDEMPOTENCY).values(at=moved))

    async def save_phrase(self, record: PhraseRecord, answer: StoredResponse | None = None) -> None:
        """See `Store.save_phrase`."""
        async with self._transaction() as connection:
            await connection.execute(_one_phrase(record.owner, record.language, record.key))
            await connection.execute(insert(PHRASES), phrase_to_row(record))
            if answer is not None:
                await connection.execute(insert(IDEMPOTENCY), response_to_row(answer))

    async def delete_phrase(
        self, owner: str, language: str, key: str, answer: StoredResponse | None = None
    ) -> bool:
        """See `Store.delete_phrase`."""
        async with self._transaction() as connection:
            result = await connection.execute(_one_phrase(owner, language, key))
            if answer is not None:
                await connection.execute(insert(IDEMPOTENCY), response_to_row(answer))
        return result.rowcount > 0

    async def phrases(self, owner: str | None = None) -> Sequence[PhraseRecord]:
        """See `Store.phrases`."""
        query = select(PHRASES).order_by(PHRASES.c.owner, PHRASES.c.language, PHRASES.c.key)
        if owner is not None:
            query = query.where(PHRASES.c.owner == owner)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [
            PhraseRecord(
                owner=row.owner, language=row.language, key=row.key, phrase=row.phrase, meaning=row.meaning
            )
            for row in rows
        ]

    async def secret(self, name: str) -> bytes:
        """See `Store.secret`."""
        async with self._transaction() as connection:
            found = select(SECRETS.c.value).where(SECRETS.c.name == name)
            value = (await connection.execute(found)).scalar_one_or_none()
            if value is None:
                value = secrets.token_bytes(SECRET_BYTES)
                await connection.execute(insert(SECRETS), {"name": name, "value": value})
        return bytes(value)

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

    async def _write(self) -> None:
        """Commit pending entries, batch by batch, until there are none."""
        try:
            while self._pending:
                batch, self._pending = self._pending, []
                await self._write_batch(batch)
        finally:
            self._writer = None

    async def _write_batch(self, batch: list[_Pending], *, again: bool = True) -> None:
        try:
            async with self._transaction() as connection:
                await _insert(connection, [(of, entry) for of, entry, _, _ in batch])
                answers = [response_to_row(answer) for _, _, answer, _ in batch if answer is not None]
                if answers:
                    await connection.execute(insert(IDEMPOTENCY), answers)
        except StoreError as error:
            if isinstance(error, _LostError):
                for of, entry, answer, _ in batch:
                    self._uncertain.append(
                        delete(ENTRIES).where(
                            ENTRIES.c.session_id == of, ENTRIES.c.sequence == entry.sequence
                        )
                    )
                    self._mark_uncertain(answer)
            if isinstance(error, _LostError) and again:
                await self._write_batch(batch, again=False)
            elif len(batch) > 1:
                # One bad entry must not fail its neighbours: each gets its own commit.
                for pending in batch:
                    await self._write_batch([pending], again=False)
            elif not batch[0][3].done():
                batch[0][3].set_exception(error)
        else:
            for _, _, _, done in batch:
                if not done.done():
                    done.set_result(None)

    def _mark_uncertain(self, *answers: StoredResponse | None) -> None:
        for answer in answers:
            if answer is not None:
                self._uncertain.append(delete(IDEMPOTENCY).where(IDEMPOTENCY.c.key == answer.key))

    @asynccontextmanager
    async def _transaction(self) -> AsyncIterator[AsyncConnection]:
        if self._engine is None:
            raise StoreError("The database is not open")
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
            raise (_LostError if lost else StoreError)(driver_message(error)) from error
        except ValueError as error:
            # Reading JSON: the file was damaged in a place that its own structure does not show.
            raise StoreError(f"what is kept cannot be read: {error}") from error


def _utc(at: datetime) -> datetime:
    """As times are stored."""
    return at.astimezone(UTC).replace(tzinfo=None)


def _one_phrase(owner: str, language: str, key: str) -> Delete:
    found = (PHRASES.c.owner == owner, PHRASES.c.language == language, PHRASES.c.key == key)
    return delete(PHRASES).where(*found)


async def _insert(connection: AsyncConnection, entries: Sequence[tuple[str, EntryRecord]]) -> None:
    """Keep entries of sessions, and the names they give."""
    if not entries:
        return
    await connection.execute(insert(ENTRIES), [entry_to_row(of, entry) for of, entry in entries])
    named = [values for of, entry in entries for values in bookmarks_to_rows(of, entry)]
    if named:
        again = (MOMENTS.c.session_id == bindparam("of"), MOMENTS.c.name == bindparam("called"))
        old = [{"of": values["session_id"], "called": values["name"]} for values in named]
        await connection.execute(delete(MOMENTS).where(*again), old)
        await connection.execute(insert(MOMENTS), named)


async def _own_entries(connection: AsyncConnection, session_id: str, most: int | None) -> list[EntryRecord]:
    query = select(ENTRIES).where(ENTRIES.c.session_id == session_id).order_by(ENTRIES.c.sequence)
    if most is not None:
        query = query.where(ENTRIES.c.sequence <= most)
    found: list[EntryRecord] = []
    while True:
        last = found[-1].sequence if found else 0
        rows = (await connection.execute(query.where(ENTRIES.c.sequence > last).limit(_PAGE))).all()
        found += map(entry_from_row, rows)
        if len(rows) < _PAGE:
            return found
