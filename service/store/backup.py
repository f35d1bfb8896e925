"""Backups: everything a store holds as one SQLite file, from whatever database it comes.

SQLite copies its own pages in small steps, between which others use the same connection; what they commit
meanwhile is in the copy as well. A server's tables are read over a second connection, as they stand at one
moment. The file is complete in itself (no log of changes beside it) and is checked before it is used.
"""

from __future__ import annotations

import sqlite3
import threading
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anyio import to_thread
from sqlalchemy import Connection, Table, create_engine, func, insert, inspect, select
from sqlalchemy.ext.asyncio import AsyncConnection
from sqlalchemy.pool import NullPool

from service.store.base import StoreError
from service.store.schema import migrate, version_of
from service.store.tables import ENTRIES, METADATA, SESSIONS, VERSION

_STEP_PAGES = 64
"""Pages copied in one step, 256 KiB: a change that comes meanwhile waits for one step."""
_PAUSE_S = 0.001
"""Between two steps, so that a change takes its turn."""
_ROWS = 500
"""Rows that are read and written together."""

_Rows = Sequence[Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class BackupFacts:
    """What a backup holds: the version of its tables, and how many sessions and changes."""

    version: int
    sessions: int
    entries: int


def copy_sqlite(source: sqlite3.Connection, target: Path, stopped: threading.Event) -> None:
    """Copy a SQLite database in small steps. Raises `StoreError` when it is stopped; blocks."""

    def between(_status: int, _remaining: int, _total: int) -> None:
        if stopped.is_set():
            raise StoreError("The service stops, so the backup was not finished.")
        time.sleep(_PAUSE_S)

    with closing(sqlite3.connect(target)) as copy:
        source.backup(copy, pages=_STEP_PAGES, progress=between, sleep=_PAUSE_S)
        copy.execute("PRAGMA journal_mode=DELETE")


async def copy_server(connection: AsyncConnection, target: Path, stopped: threading.Event) -> None:
    """Copy a server's tables, as the connection's transaction sees them. Raises `StoreError`."""
    version = await connection.run_sync(version_of)
    if version != VERSION:
        raise StoreError(
            f"The database is of version {version}, and this roadtalk copies version {VERSION} only. Start "
            "the service once to upgrade it, or use pg_dump."
        )
    writer = await to_thread.run_sync(_Writer, target)
    try:
        for table in METADATA.sorted_tables:
            async for rows in (await connection.stream(select(table))).mappings().partitions(_ROWS):
                if stopped.is_set():
                    raise StoreError("The service stops, so the backup was not finished.")
                await to_thread.run_sync(writer.add, table, [dict(row) for row in rows])
        await to_thread.run_sync(writer.commit)
    finally:
        await to_thread.run_sync(writer.close)


def write_file(target: Path, contents: Iterable[tuple[Table, _Rows]]) -> None:
    """Write rows of tables, in the order of their references, into a new file; blocks."""
    writer = _Writer(target)
    try:
        for table, rows in contents:
            writer.add(table, rows)
        writer.commit()
    finally:
        writer.close()


class _Writer:
    """A new SQLite file with the tables of now."""

    def __init__(self, target: Path) -> None:
        self._engine = create_engine(
            "sqlite://", creator=lambda: sqlite3.connect(target, check_same_thread=False), poolclass=NullPool
        )
        self._connection = self._engine.connect()
        migrate(self._connection, str(target))

    def add(self, table: Table, rows: _Rows) -> None:
        insert_rows(self._connection, table, rows)

    def commit(self) -> None:
        self._connection.commit()

    def close(self) -> None:
        self._connection.close()
        self._engine.dispose()


def insert_rows(connection: Connection, table: Table, rows: _Rows) -> None:
    """Insert rows as they are; None is NULL in every column, also in those of JSON."""
    alike: dict[tuple[str, ...], list[dict[str, Any]]] = {}
    for row in rows:
        given = {name: value for name, value in row.items() if value is not None}
        alike.setdefault(tuple(given), []).append(given)
    for together in alike.values():
        connection.execute(insert(table), together)


def check_backup(path: Path) -> BackupFacts:
    """Whether a file is a whole backup that this version can use. Raises `StoreError`; blocks."""

    def read_only() -> sqlite3.Connection:
        return sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro&immutable=1", uri=True)

    try:
        with closing(read_only()) as file:
            found = " ".join(str(file.execute("PRAGMA integrity_check(1)").fetchone()[0]).split())
            orphan = file.execute("PRAGMA foreign_key_check").fetchone()
    except (sqlite3.Error, UnicodeDecodeError) as error:
        raise StoreError(f"{path} is no backup, or is damaged: {error}") from error
    if found != "ok" or orphan is not None:
        raise StoreError(f"{path} is damaged: {found if found != 'ok' else f'{orphan[0]} without a session'}")
    engine = create_engine("sqlite://", creator=read_only, poolclass=NullPool)
    with engine.connect() as connection:
        return _facts(connection, path)


def _facts(connection: Connection, path: Path) -> BackupFacts:
    version = version_of(connection)
    tables = set(inspect(connection).get_table_names())
    if version is None or not {"sessions", "entries"} <= tables:
        raise StoreError(f"{path} is no backup: it holds no sessions.")
    if not 1 <= version <= VERSION:
        raise StoreError(
            f"{path} is of version {version}, made by a newer roadtalk; this one knows versions up to "
            f"{VERSION}."
        )
    sessions, entries = (
        int(connection.execute(select(func.count()).select_from(table)).scalar_one())
        for table in (SESSIONS, ENTRIES)
    )
    return BackupFacts(version, sessions, entries)
