"""The stored responses of the SQL store."""

from __future__ import annotations

from sqlalchemy import delete, func, insert, select, update

from service.store.base import StoredResponse
from service.store.rows import response_to_row
from service.store.sql_base import SqlTransactions
from service.store.tables import IDEMPOTENCY


class SqlResponses(SqlTransactions):
    """What `service.store.sql.SqlStore` does about responses; see `Store` for each."""

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
