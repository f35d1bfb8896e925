"""The sessions of the SQL store, with their snapshots and bookmarks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from datetime import UTC, datetime

from sqlalchemy import bindparam, delete, func, insert, select, update
from sqlalchemy.ext.asyncio import AsyncConnection

from service.store.base import (
    BookmarkRecord,
    Branch,
    EntryRecord,
    SessionRecord,
    SnapshotRecord,
    StoredResponse,
    StoreError,
)
from service.store.fork_log import join_logs
from service.store.rows import (
    entry_from_row,
    response_to_row,
    session_from_row,
    session_to_row,
    snapshot_from_row,
    snapshot_to_row,
)
from service.store.sql_base import LostError, SqlTransactions, insert_entries
from service.store.tables import ENTRIES, IDEMPOTENCY, MOMENTS, SESSIONS, SNAPSHOTS

_PAGE = 500
"""Entries in a page: making records of rows blocks the event loop."""


class SqlSessions(SqlTransactions):
    """What `service.store.sql.SqlStore` does about sessions; see `Store` for each."""

    def __init__(self) -> None:
        super().__init__()
        self.unseen: set[str] = set()
        """sessions deleted by this process, whose forks may still have their entries"""

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: StoredResponse | None = None
    ) -> SessionRecord:
        """See `Store.create`."""
        try:
            return await self._create(record, entries, answer)
        except LostError:
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
            await insert_entries(connection, [(record.id, entry) for entry in entries])
            if answer is not None:
                await connection.execute(insert(IDEMPOTENCY), response_to_row(answer))
        return record.with_number(number)

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

    async def rename(self, session_id: str, name: str | None) -> bool:
        """See `Store.rename`."""
        named = update(SESSIONS).where(SESSIONS.c.id == session_id, ~SESSIONS.c.unseen).values(name=name)
        async with self._transaction() as connection:
            return (await connection.execute(named)).rowcount > 0

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
        self.unseen.add(session_id)
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


def _utc(at: datetime) -> datetime:
    """As times are stored."""
    return at.astimezone(UTC).replace(tzinfo=None)


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
