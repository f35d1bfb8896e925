"""The taught phrases and secrets of the SQL store."""

from __future__ import annotations

import secrets
from collections.abc import Sequence

from sqlalchemy import Delete, delete, insert, select

from service.store.base import SECRET_BYTES, PhraseRecord, StoredResponse
from service.store.rows import phrase_to_row, response_to_row
from service.store.sql_base import SqlTransactions
from service.store.tables import IDEMPOTENCY, PHRASES, SECRETS


class SqlPhrases(SqlTransactions):
    """What `service.store.sql.SqlStore` does about phrases and secrets; see `Store` for each."""

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


def _one_phrase(owner: str, language: str, key: str) -> Delete:
    found = (PHRASES.c.owner == owner, PHRASES.c.language == language, PHRASES.c.key == key)
    return delete(PHRASES).where(*found)
