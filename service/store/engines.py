"""Database engines: one exclusive, durable connection of one process.

A session is live in one process, so a second service on the same database would believe that it owns the same
sessions: it is refused at its start. SQLite's file is locked (versions before 3.51.3 can also lose a WAL
reset when several connections write); PostgreSQL gives an advisory lock that ends with the connection.
Shards of one service share the database: each locks its own number, and none opens beside another service.
What is acknowledged is on disk: `synchronous=FULL`, `synchronous_commit=on`. SQLite's calls run on the
driver's own thread, never on the event loop.
"""

from __future__ import annotations

import asyncio
import os
import sqlite3
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from anyio import to_thread
from sqlalchemy import event
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, DBAPIError, SQLAlchemyError
from sqlalchemy.ext.asyncio import AsyncEngine, create_async_engine
from sqlalchemy.pool import AsyncAdaptedQueuePool

from service.sharding import SINGLE, Shard
from service.store import wal
from service.store.backup import copy_server, copy_sqlite
from service.store.base import LockedError, StoreError

_BUSY_S = 1.0
"""Time to wait for a file or table that another process has locked."""

_ANSWER_S = 10.0
"""Time limit for an answer of a database server."""

_LOCK = 0x0A0D7A1C
"""The advisory lock of a service, in the database it uses."""

_TRIES = 10
"""Number of attempts to take it within `_BUSY_S`."""

_HELD = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)

_PRAGMAS = (
    f"PRAGMA busy_timeout={_BUSY_S * 1000:.0f}",
    "PRAGMA locking_mode=EXCLUSIVE",
    "PRAGMA journal_mode=WAL",
    "PRAGMA synchronous=FULL",
    "PRAGMA foreign_keys=ON",
)


class Sqlite:
    """A SQLite file."""

    def __init__(self, url: URL) -> None:
        self._url = url.set(drivername="sqlite+aiosqlite")
        self._path = url.database or ""
        self._open: sqlite3.Connection | None = None
        self._writer = ThreadPoolExecutor(1, "log")
        self.path = Path(self._path)
        self.name = f"The database {self._path}"

    async def check(self) -> None:
        """Raise `StoreError` where the file cannot be used, or is damaged.

        By a plain connection: the asynchronous driver leaves its thread behind when it cannot connect.
        """
        try:
            found = await to_thread.run_sync(self._check)
        except UnicodeDecodeError:
            found = "not even the fault can be told"  # SQLite's message quotes it
        except (sqlite3.OperationalError, OSError) as error:
            if isinstance(error, sqlite3.Error) and error.sqlite_errorcode in _HELD:
                raise LockedError(
                    f"{self.name} cannot be opened: it is locked: another program, perhaps another Roadtalk "
                    "service, has it open. Stop that one, or name another file in ROADTALK_DATABASE."
                ) from error
            raise StoreError(f"{self.name} cannot be opened: {error}") from error
        except sqlite3.Error as error:
            found = str(error)
        if found != "ok":
            raise StoreError(
                f"{self.name} cannot be opened: it is damaged or none ({found}). It was left as it is; "
                "put a copy in its place, or save what can be read with: sqlite3 <file> .recover"
            )

    def _check(self) -> str:
        path = Path(self._path)
        _check_permissions(path)
        # Where there is a log of changes, closing would write it into what may be damaged: only looked at.
        how = "ro" if path.with_name(f"{path.name}-wal").exists() else "rwc"
        connection = sqlite3.connect(f"{path.resolve().as_uri()}?mode={how}", uri=True, timeout=_BUSY_S)
        try:
            connection.execute("PRAGMA schema_version").fetchone()
            lost = wal.defect(path)
            if lost is not None:
                return lost
            return " ".join(str(connection.execute("PRAGMA quick_check(1)").fetchone()[0]).split())
        finally:
            connection.close()

    def engine(self) -> AsyncEngine:
        """An engine with one connection and no overflow: callers queue for it, so writes never overlap."""
        # A rollback after each transaction, ended or not, is one more way to the driver's thread and back: as
        # long as all else but the disk.
        engine = _one_connection(
            self._url,
            _prepare_sqlite,
            pool_reset_on_return=None,
            connect_args={"factory": self._connect, "check_same_thread": False},
        )
        event.listen(engine.sync_engine, "reset", _end_left_open)
        return engine

    async def run(self, write: Callable[[sqlite3.Connection], None]) -> bool:
        """Call a function with the open connection, which nobody else uses, on a thread of its own.

        False where there is no connection to be had so, and nothing was done. Raises what the function does.
        """
        connection = self._open
        if connection is None:
            return False
        return await asyncio.get_running_loop().run_in_executor(self._writer, _write_idle, connection, write)

    async def copy_open(self, target: Path, stopped: threading.Event) -> None:
        """Copy the database that the engine has open; reads and writes go on between the steps."""
        if self._open is None:
            raise StoreError("The database is not open")
        await to_thread.run_sync(copy_sqlite, self._open, target, stopped)

    async def copy(self, target: Path) -> None:
        """Copy a database that nobody has open. Raises `LockedError` or `StoreError`."""
        if not self.path.exists():
            raise StoreError(f"{self.name} is not there.")
        await self.check()
        await to_thread.run_sync(self._copy, target)

    def _copy(self, target: Path) -> None:
        with closing(sqlite3.connect(self.path, timeout=_BUSY_S)) as connection:
            connection.execute("PRAGMA locking_mode=EXCLUSIVE")
            copy_sqlite(connection, target, threading.Event())

    def _connect(self, *given: Any, **named: Any) -> sqlite3.Connection:
        """The driver's connection, which is also that of a backup: no second one may open the file."""
        self._open = sqlite3.Connection(*given, **named)
        return self._open


def _write_idle(connection: sqlite3.Connection, write: Callable[[sqlite3.Connection], None]) -> bool:
    """Write, unless a transaction was left open or the connection is closed."""
    try:
        if connection.in_transaction:
            return False
    except sqlite3.ProgrammingError:
        return False
    write(connection)
    return True


def _check_permissions(path: Path) -> None:
    """Raise `OSError` if a file may not be used, with a clearer message than SQLite's."""
    if path.is_dir():
        raise OSError("it is a folder")
    if not path.parent.is_dir():
        raise OSError(f"there is no folder {path.parent}")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise OSError("its folder is read-only, and a log of changes must be kept beside it")
    if path.exists() and not os.access(path, os.R_OK | os.W_OK):
        raise OSError("it is read-only, or not to be read at all")


class Postgres:
    """A PostgreSQL server, by the driver asyncpg (extra `postgres`)."""

    def __init__(self, url: URL, shard: Shard = SINGLE) -> None:
        if find_spec("asyncpg") is None:
            raise StoreError("PostgreSQL needs its driver: pip install 'roadtalk[postgres]'")
        self._locks = _locks(shard)
        self._url = url.set(drivername="postgresql+asyncpg")
        self.name = f"The database {url.database or ''} on {url.host or 'this machine'}"

    async def check(self) -> None:
        """Do nothing: the server checks its own files."""

    def engine(self) -> AsyncEngine:
        """See `Sqlite.engine`."""
        server = {"application_name": "roadtalk", "lock_timeout": f"{_BUSY_S * 1000:.0f}"}
        return _one_connection(
            self._url,
            partial(_prepare_postgres, self._locks),
            connect_args={"timeout": _ANSWER_S, "command_timeout": _ANSWER_S, "server_settings": server},
        )

    async def copy_open(self, target: Path, stopped: threading.Event) -> None:
        """Copy what the database holds now, over a connection of its own that only reads."""
        engine = create_async_engine(
            self._url, isolation_level="REPEATABLE READ", connect_args={"timeout": _ANSWER_S}
        )
        try:
            async with engine.connect() as connection:
                await copy_server(connection, target, stopped)
        finally:
            await engine.dispose()

    async def copy(self, target: Path) -> None:
        """The same: a service that runs is not in the way. Raises `StoreError`."""
        try:
            await self.copy_open(target, threading.Event())
        except (SQLAlchemyError, OSError, ValueError) as error:
            raise StoreError(f"{self.name} cannot be read: {driver_message(error)}") from error


def database_for(url: str, shard: Shard = SINGLE) -> Sqlite | Postgres:
    """The database that a URL names. Raises `StoreError`."""
    try:
        parts = make_url(url)
    except (ArgumentError, ValueError) as error:
        raise StoreError("The database's URL cannot be read.") from error
    return Sqlite(parts) if parts.get_backend_name() == "sqlite" else Postgres(parts, shard)


def driver_message(error: Exception) -> str:
    """A driver's error message, without the statement it was about."""
    inner = error.orig if isinstance(error, DBAPIError) else None
    said = str((inner and (inner.__cause__ or inner)) or error)
    return said or type(error).__name__


def _one_connection(url: URL, prepare: Any, **more: Any) -> AsyncEngine:
    engine = create_async_engine(
        url, poolclass=AsyncAdaptedQueuePool, pool_size=1, max_overflow=0, pool_timeout=30, **more
    )
    event.listen(engine.sync_engine, "connect", prepare)
    return engine


def _prepare_sqlite(connection: Any, _record: Any) -> None:
    cursor = connection.cursor()
    for pragma in _PRAGMAS:
        cursor.execute(pragma)
    cursor.close()


def _end_left_open(connection: Any, _record: Any, state: Any) -> None:
    """Roll back a transaction that nobody ended, so that the next one does not commit it."""
    if state.asyncio_safe and connection.driver_connection.in_transaction:
        connection.rollback()


def _locks(shard: Shard) -> tuple[str, ...]:
    """The locks of a process: the whole database alone, or shared, and a shard's own number alone."""
    if shard.count == 1:
        return (f"pg_try_advisory_lock({_LOCK})",)
    return (f"pg_try_advisory_lock_shared({_LOCK})", f"pg_try_advisory_lock({_LOCK}, {shard.number})")


def _prepare_postgres(locks: tuple[str, ...], connection: Any, _record: Any) -> None:
    cursor = connection.cursor()
    cursor.execute("SET synchronous_commit TO on")
    # The server may take a moment to see that our own connection from before is gone.
    tries = _TRIES
    for lock in locks:
        while not (held := _take(cursor, lock)) and (tries := tries - 1) > 0:
            cursor.execute(f"SELECT pg_sleep({_BUSY_S / _TRIES})")
            cursor.fetchone()
        if not held:
            break
    cursor.close()
    connection.commit()
    if not held:
        connection.close()
        raise StoreError(
            "The database is locked: another service uses it. Stop that one, or name another in "
            "ROADTALK_DATABASE."
        )


def _take(cursor: Any, lock: str) -> bool:
    cursor.execute(f"SELECT {lock}")
    (held,) = cursor.fetchone()
    return bool(held)
