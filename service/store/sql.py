"""The real store: SQL through SQLAlchemy Core, a SQLite file by default, PostgreSQL by URL.

One connection in one process; `engines` says how each kind of database is held, and that a second
service on the same one is refused at its start.

Changes that arrive while one is being written are committed together (group commit): the disk is
waited for once for all of them, and none is acknowledged before its own commit.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Delete, Row, bindparam, delete, func, insert, select, update
from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.ext.asyncio import AsyncConnection, AsyncEngine

from service.store.base import EntryRecord, KeptAnswer, PhraseRecord, SessionRecord, StoreError
from service.store.engines import Postgres, Sqlite, kind_of, reason
from service.store.schema import bring_up
from service.store.tables import ENTRIES, IDEMPOTENCY, PHRASES, SESSIONS

_Pending = tuple[dict[str, Any], KeptAnswer | None, "asyncio.Future[None]"]


class SqlStore:
    """`Store` in a database named by URL (`sqlite:///roadtalk.db`, `postgresql://host/name`)."""

    def __init__(self, url: str) -> None:
        """Raises `StoreError` where what that kind of database needs is not installed."""
        self._kind: Sqlite | Postgres = kind_of(url)
        self._engine: AsyncEngine | None = None
        self._pending: list[_Pending] = []
        self._writer: asyncio.Task[None] | None = None

    async def open(self) -> None:
        """Open the database, making its tables or bringing older ones up if need be. Raises `StoreError`."""
        if self._engine is not None:
            return
        await self._kind.check()
        engine = self._kind.engine()
        try:
            async with engine.connect() as connection:
                await connection.run_sync(bring_up, self._kind.name)
                await connection.commit()
        except (SQLAlchemyError, OSError, ValueError, StoreError) as error:
            await engine.dispose()
            if isinstance(error, StoreError):
                raise
            raise StoreError(f"{self._kind.name} cannot be opened: {reason(error)}") from error
        self._engine = engine

    async def close(self) -> None:
        """Finish what is being written and let go of the database."""
        if self._writer is not None:
            await asyncio.wait([self._writer])
        if self._engine is not None:
            await self._engine.dispose()
            self._engine = None

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: KeptAnswer | None = None
    ) -> SessionRecord:
        """See `Store.create`."""
        values = {
            "id": record.id,
            "name": record.name,
            "created_at": record.created_at.astimezone(UTC).replace(tzinfo=None),
            "config": dict(record.config),
            "paused": record.paused,
            "tick": record.tick,
        }
        async with self._transaction() as connection:
            number = (
                await connection.execute(insert(SESSIONS).returning(SESSIONS.c.number), values)
            ).scalar_one()
            if entries:
                await connection.execute(
                    insert(ENTRIES), [_entry_values(record.id, entry) for entry in entries]
                )
            if answer is not None:
                await connection.execute(insert(IDEMPOTENCY), _answer_values(answer))
        return record.numbered(number)

    async def append(self, session_id: str, entry: EntryRecord, answer: KeptAnswer | None = None) -> None:
        """See `Store.append`; joins the next group commit."""
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._pending.append((_entry_values(session_id, entry), answer, done))
        if self._writer is None:
            self._writer = asyncio.create_task(self._write())
        await done

    async def get(self, session_id: str) -> SessionRecord | None:
        """See `Store.get`."""
        async with self._transaction() as connection:
            row = (
                await connection.execute(select(SESSIONS).where(SESSIONS.c.id == session_id))
            ).one_or_none()
        return None if row is None else _session(row)

    async def entries(self, session_id: str) -> Sequence[EntryRecord]:
        """See `Store.entries`."""
        query = select(ENTRIES).where(ENTRIES.c.session_id == session_id).order_by(ENTRIES.c.sequence)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [
            EntryRecord(
                sequence=row.sequence, tick=row.tick, text=row.text, actions=row.actions, digest=row.digest
            )
            for row in rows
        ]

    async def newest(self, limit: int, before: int | None = None) -> Sequence[SessionRecord]:
        """See `Store.newest`."""
        query = select(SESSIONS).order_by(SESSIONS.c.number.desc()).limit(limit)
        if before is not None:
            query = query.where(SESSIONS.c.number < before)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [_session(row) for row in rows]

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        """See `Store.save_ticks`."""
        if not ticks:
            return
        change = update(SESSIONS).where(SESSIONS.c.id == bindparam("of")).values(tick=bindparam("at"))
        async with self._transaction() as connection:
            await connection.execute(change, [{"of": of, "at": at} for of, at in ticks.items()])

    async def delete(self, session_id: str) -> bool:
        """See `Store.delete`."""
        async with self._transaction() as connection:
            result = await connection.execute(delete(SESSIONS).where(SESSIONS.c.id == session_id))
        return result.rowcount > 0

    async def keep(self, answer: KeptAnswer) -> None:
        """See `Store.keep`."""
        async with self._transaction() as connection:
            await connection.execute(insert(IDEMPOTENCY), _answer_values(answer))

    async def kept(self, key: str) -> KeptAnswer | None:
        """See `Store.kept`."""
        async with self._transaction() as connection:
            row = (
                await connection.execute(select(IDEMPOTENCY).where(IDEMPOTENCY.c.key == key))
            ).one_or_none()
        return None if row is None else KeptAnswer(**row._mapping)

    async def forget_answers(self, before: int) -> None:
        """See `Store.forget_answers`."""
        async with self._transaction() as connection:
            await connection.execute(delete(IDEMPOTENCY).where(IDEMPOTENCY.c.at < before))

    async def date_answers(self, newest: int) -> None:
        """See `Store.date_answers`."""
        async with self._transaction() as connection:
            latest = (await connection.execute(select(func.max(IDEMPOTENCY.c.at)))).scalar_one()
            if latest is not None and latest != newest:
                moved = IDEMPOTENCY.c.at + (newest - latest)
                await connection.execute(update(IDEMPOTENCY).values(at=moved))

    async def teach(self, record: PhraseRecord) -> None:
        """See `Store.teach`."""
        values = {
            "owner": record.owner,
            "language": record.language,
            "key": record.key,
            "phrase": record.phrase,
            "meaning": [dict(action) for action in record.meaning],
        }
        async with self._transaction() as connection:
            await connection.execute(_one_phrase(record.owner, record.language, record.key))
            await connection.execute(insert(PHRASES), values)

    async def forget(self, owner: str, language: str, key: str) -> bool:
        """See `Store.forget`."""
        async with self._transaction() as connection:
            result = await connection.execute(_one_phrase(owner, language, key))
        return result.rowcount > 0

    async def phrases(self, owner: str) -> Sequence[PhraseRecord]:
        """See `Store.phrases`."""
        query = select(PHRASES).where(PHRASES.c.owner == owner).order_by(PHRASES.c.language, PHRASES.c.key)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [
            PhraseRecord(
                owner=row.owner, language=row.language, key=row.key, phrase=row.phrase, meaning=row.meaning
            )
            for row in rows
        ]

    async def _write(self) -> None:
        """Commit what is pending, batch by batch, until nothing is."""
        try:
            while self._pending:
                batch, self._pending = self._pending, []
                await self._write_batch(batch)
        finally:
            self._writer = None

    async def _write_batch(self, batch: list[_Pending]) -> None:
        try:
            async with self._transaction() as connection:
                await connection.execute(insert(ENTRIES), [values for values, _, _ in batch])
                answers = [_answer_values(answer) for _, answer, _ in batch if answer is not None]
                if answers:
                    await connection.execute(insert(IDEMPOTENCY), answers)
        except StoreError as error:
            if len(batch) > 1:
                # One bad entry must not fail its neighbours: each gets its own commit.
                for pending in batch:
                    await self._write_batch([pending])
            elif not batch[0][2].done():
                batch[0][2].set_exception(error)
        else:
            for _, _, done in batch:
                if not done.done():
                    done.set_result(None)

    @asynccontextmanager
    async def _transaction(self) -> AsyncIterator[AsyncConnection]:
        if self._engine is None:
            raise StoreError("The database is not open")
        try:
            async with self._engine.begin() as connection:
                yield connection
        except (SQLAlchemyError, OSError) as error:
            raise StoreError(reason(error)) from error
        except ValueError as error:
            # Reading JSON: the file was damaged in a place that its own structure does not show.
            raise StoreError(f"what is kept cannot be read: {error}") from error


def _one_phrase(owner: str, language: str, key: str) -> Delete:
    found = (PHRASES.c.owner == owner, PHRASES.c.language == language, PHRASES.c.key == key)
    return delete(PHRASES).where(*found)


def _session(row: Row[Any]) -> SessionRecord:
    return SessionRecord(
        id=row.id,
        name=row.name,
        created_at=_utc(row.created_at),
        config=row.config,
        paused=row.paused,
        tick=row.tick,
        number=row.number,
    )


def _utc(moment: datetime) -> datetime:
    return moment.replace(tzinfo=UTC)


def _answer_values(answer: KeptAnswer) -> dict[str, Any]:
    return {
        "key": answer.key,
        "request": answer.request,
        "at": answer.at,
        "status": answer.status,
        "headers": dict(answer.headers),
        "body": answer.body,
    }


def _entry_values(session_id: str, entry: EntryRecord) -> dict[str, Any]:
    return {
        "session_id": session_id,
        "sequence": entry.sequence,
        "tick": entry.tick,
        "text": entry.text,
        "actions": [dict(action) for action in entry.actions],
        "digest": entry.digest,
    }
