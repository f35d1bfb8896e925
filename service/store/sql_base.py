"""What all parts of the SQL store share: transactions, and rows that may have been committed."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractAsyncContextManager

from sqlalchemy import Delete, bindparam, delete, insert
from sqlalchemy.ext.asyncio import AsyncConnection

from service.store.base import EntryRecord, StoredResponse, StoreError
from service.store.rows import bookmarks_to_rows, entry_to_row
from service.store.tables import ENTRIES, IDEMPOTENCY, MOMENTS


class LostError(StoreError):
    """The server is gone or does not answer: the transaction may have been committed."""


class SqlTransactions:
    """Base of the parts of `service.store.sql.SqlStore`."""

    def __init__(self) -> None:
        self._uncertain: list[Delete] = []
        """deletes rows that were not acknowledged and may have been committed"""

    def _transaction(self) -> AbstractAsyncContextManager[AsyncConnection]:
        """One transaction, alone on the store's connection. Raises `StoreError`."""
        raise NotImplementedError

    def _mark_uncertain(self, *answers: StoredResponse | None) -> None:
        for answer in answers:
            if answer is not None:
                self._uncertain.append(delete(IDEMPOTENCY).where(IDEMPOTENCY.c.key == answer.key))


async def insert_entries(connection: AsyncConnection, entries: Sequence[tuple[str, EntryRecord]]) -> None:
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
