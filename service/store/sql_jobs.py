"""The jobs of the SQL store."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC
from typing import Any

from sqlalchemy import Row, delete, insert, select, update

from service.store.base import JobRecord
from service.store.sql_base import SqlTransactions
from service.store.tables import JOB_PARTS, JOBS


class SqlJobs(SqlTransactions):
    """What `service.store.sql.SqlStore` does about jobs; see `Store` for each."""

    async def create_job(self, record: JobRecord) -> JobRecord:
        """See `Store.create_job`."""
        values = {
            "id": record.id,
            "kind": record.kind,
            "created_at": record.created_at.replace(tzinfo=None),
            "spec": dict(record.spec),
            **_changing(record),
        }
        async with self._transaction() as connection:
            number = (await connection.execute(insert(JOBS).returning(JOBS.c.number), values)).scalar_one()
        return _numbered(record, number)

    async def update_job(self, record: JobRecord) -> None:
        """See `Store.update_job`."""
        async with self._transaction() as connection:
            await connection.execute(update(JOBS).where(JOBS.c.id == record.id).values(**_changing(record)))

    async def job(self, job_id: str) -> JobRecord | None:
        """See `Store.job`."""
        async with self._transaction() as connection:
            row = (await connection.execute(select(JOBS).where(JOBS.c.id == job_id))).one_or_none()
        return None if row is None else _from_row(row, row.result)

    async def jobs(
        self, limit: int, before: int | None = None, state: str | None = None
    ) -> Sequence[JobRecord]:
        """See `Store.jobs`."""
        columns = [column for column in JOBS.c if column.name != "result"]
        query = select(*columns).order_by(JOBS.c.number.desc()).limit(limit)
        if before is not None:
            query = query.where(JOBS.c.number < before)
        if state is not None:
            query = query.where(JOBS.c.state == state)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return [_from_row(row) for row in rows]

    async def delete_job(self, job_id: str) -> bool:
        """See `Store.delete_job`."""
        async with self._transaction() as connection:
            await connection.execute(delete(JOB_PARTS).where(JOB_PARTS.c.job_id == job_id))
            return (await connection.execute(delete(JOBS).where(JOBS.c.id == job_id))).rowcount > 0

    async def save_job_part(self, job_id: str, key: str, body: bytes, done: int) -> None:
        """See `Store.save_job_part`."""
        async with self._transaction() as connection:
            change = update(JOBS).where(JOBS.c.id == job_id).values(done=done)
            if (await connection.execute(change)).rowcount == 0:
                return
            same = (JOB_PARTS.c.job_id == job_id, JOB_PARTS.c.key == key)
            await connection.execute(delete(JOB_PARTS).where(*same))
            await connection.execute(insert(JOB_PARTS), {"job_id": job_id, "key": key, "body": body})

    async def job_parts(self, job_id: str) -> Mapping[str, bytes]:
        """See `Store.job_parts`."""
        query = select(JOB_PARTS.c.key, JOB_PARTS.c.body).where(JOB_PARTS.c.job_id == job_id)
        async with self._transaction() as connection:
            rows = (await connection.execute(query)).all()
        return {row.key: row.body for row in rows}


def _changing(record: JobRecord) -> dict[str, Any]:
    """The columns that change while a job is run."""
    return {
        "state": record.state,
        "done": record.done,
        "total": record.total,
        "result": None if record.result is None else dict(record.result),
        "error": record.error,
    }


def _numbered(record: JobRecord, number: int) -> JobRecord:
    return replace(record, number=number)


def _from_row(row: Row[Any], result: Any = None) -> JobRecord:
    return JobRecord(
        id=row.id,
        kind=row.kind,
        state=row.state,
        created_at=row.created_at.replace(tzinfo=UTC),
        spec=row.spec,
        done=row.done,
        total=row.total,
        result=result,
        error=row.error,
        number=row.number,
    )
