"""Puts a backup in the place of a database: SQLite or PostgreSQL, whichever the backup was made from.

The backup is checked first; nothing is replaced unless that is asked for, and a SQLite file that is replaced
is kept beside the new one. A database that a service uses is refused.
"""

from __future__ import annotations

import os
import shutil
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from anyio import to_thread
from sqlalchemy import Connection, Integer, Table, create_engine, delete, func, select, text, update
from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.ext.asyncio import AsyncConnection
from sqlalchemy.pool import NullPool

from service.store.backup import BackupFacts, check_backup, insert_rows
from service.store.base import LockedError, StoreError
from service.store.engines import Postgres, Sqlite, database_for, driver_message
from service.store.schema import migrate
from service.store.tables import METADATA, SESSIONS
from service.whole_file import sync_folder, whole_file

_ROWS = 500
_LOG_PARTS = ("-wal", "-shm")
"""What SQLite may keep beside a file; they belong to that file alone."""


class NotEmptyError(StoreError):
    """There is something in the place already."""


async def restore_database(backup: Path, url: str, *, replace: bool) -> tuple[BackupFacts, Path | None]:
    """Restore a backup; also returns where the SQLite file that it replaced is kept. Raises `StoreError`."""
    facts = await to_thread.run_sync(check_backup, backup)
    database = database_for(url)
    if isinstance(database, Sqlite):
        kept = await _restore_file(backup, database, replace)
        return facts, kept
    await _restore_server(backup, database, replace)
    return facts, None


async def _restore_file(backup: Path, database: Sqlite, replace: bool) -> Path | None:
    path = database.path
    if path.exists() and not replace:
        raise NotEmptyError(f"{path} is there already; it was left as it is.")
    try:
        await database.check()
    except LockedError:
        raise
    except StoreError:
        if not path.exists():
            raise
        # A damaged database is what backups are for.
    return await to_thread.run_sync(_swap, backup, path)


def _swap(backup: Path, path: Path) -> Path | None:
    """Copy the backup into place; a file there is kept under another name."""
    if path.exists() and backup.samefile(path):
        raise StoreError(f"{path} is the backup itself.")
    try:
        with whole_file(path, replace=True) as file, backup.open("rb") as source:
            shutil.copyfileobj(source, file, 1 << 20)
            file.flush()
            _mark_used(Path(file.name))
            os.fsync(file.fileno())
            if not path.exists():
                return None
            shutil.copymode(path, file.name)
            return _keep_old(path)
    except OSError as error:
        raise StoreError(f"{path} cannot be written: {error.strerror or error}") from error


def _mark_used(path: Path) -> None:
    """Count all sessions as used now: what is restored must not be deleted for its age."""
    with closing(sqlite3.connect(path)) as connection, connection:
        columns = [row[1] for row in connection.execute("PRAGMA table_info(sessions)")]
        if "used_at" in columns:
            connection.execute("UPDATE sessions SET used_at = ?", (f"{datetime.now(UTC):%F %T.%f}",))


def _keep_old(path: Path) -> Path:
    """Give a database another name as well, and its log of changes only that one.

    A log of changes must never lie beside another database than its own.
    """
    kept = path.with_name(f"{path.name}.before-{datetime.now(UTC):%Y%m%dT%H%M%S%fZ}")
    # Closing the last connection writes the log into the file, where both are sound.
    with suppress(sqlite3.Error), closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    for part in _LOG_PARTS:
        beside = path.with_name(path.name + part)
        if beside.exists():
            os.replace(beside, kept.with_name(kept.name + part))
    try:
        os.link(path, kept)
    except OSError:  # a file system without links
        os.replace(path, kept)
    sync_folder(path.parent)
    return kept


async def _restore_server(backup: Path, database: Postgres, replace: bool) -> None:
    engine = database.engine()
    try:
        async with engine.begin() as connection:  # holds the lock of a service
            await connection.run_sync(migrate, database.name)
            if await _count_sessions(connection) and not replace:
                raise NotEmptyError(f"{database.name} holds sessions already; it was left as it is.")
            with _current_copy(backup) as copy:
                for table in reversed(METADATA.sorted_tables):
                    await connection.execute(delete(table))
                for table in METADATA.sorted_tables:
                    for rows in _pages(copy, table):
                        await connection.run_sync(insert_rows, table, rows)
                    await _set_sequence(connection, table)
            await connection.execute(update(SESSIONS).values(used_at=datetime.now(UTC).replace(tzinfo=None)))
    except (SQLAlchemyError, sqlite3.Error, OSError, ValueError) as error:
        raise StoreError(f"{database.name} cannot be restored: {driver_message(error)}") from error
    finally:
        await engine.dispose()


async def _count_sessions(connection: AsyncConnection) -> int:
    return int((await connection.execute(select(func.count()).select_from(SESSIONS))).scalar_one())


@contextmanager
def _current_copy(backup: Path) -> Iterator[Connection]:
    """A copy of the backup with the tables of now."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "backup.db"
        shutil.copyfile(backup, path)
        engine = create_engine("sqlite://", creator=lambda: sqlite3.connect(path), poolclass=NullPool)
        with closing(engine.connect()) as connection:
            migrate(connection, str(backup))
            connection.commit()
            yield connection
        engine.dispose()


def _pages(copy: Connection, table: Table) -> Iterator[Sequence[Mapping[str, Any]]]:
    for rows in copy.execute(select(table)).mappings().partitions(_ROWS):
        yield [dict(row) for row in rows]


async def _set_sequence(connection: AsyncConnection, table: Table) -> None:
    """Number on from the rows that were copied with their numbers."""
    for column in table.columns:
        if column.primary_key and column.autoincrement is True and isinstance(column.type, Integer):
            last = (await connection.execute(select(func.max(column)))).scalar_one()
            if last is not None:
                found = {"table": table.name, "column": column.name, "last": last}
                set_value = "SELECT setval(pg_get_serial_sequence(:table, :column), :last)"
                await connection.execute(text(set_value), found)
