"""Stores of sessions: one protocol, a SQL store and a store in memory.

`open_store` picks by URL; nothing outside this folder depends on which store it is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from service.sharding import SINGLE, Shard
from service.store.base import (
    BookmarkRecord,
    Branch,
    EntryRecord,
    JobRecord,
    LockedError,
    PhraseRecord,
    SessionRecord,
    SnapshotRecord,
    Store,
    StoredResponse,
    StoreError,
)
from service.store.memory import MemoryStore

if TYPE_CHECKING:
    from service.store.sql import SqlStore

__all__ = [
    "BookmarkRecord",
    "Branch",
    "EntryRecord",
    "JobRecord",
    "LockedError",
    "MemoryStore",
    "PhraseRecord",
    "SessionRecord",
    "SnapshotRecord",
    "SqlStore",
    "Store",
    "StoreError",
    "StoredResponse",
    "open_store",
]


def __getattr__(name: str) -> object:
    """`SqlStore`, when it is first used: importing SQLAlchemy takes a tenth of a second."""
    if name == "SqlStore":
        from service.store.sql import SqlStore

        return SqlStore
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def open_store(url: str, shard: Shard = SINGLE) -> Store:
    """The store a URL names, not yet opened. Raises `StoreError` for a URL of no known kind.

    `shard`: the part of a service that opens it, where several processes share a PostgreSQL database.
    """
    if url == "memory:":
        return MemoryStore()
    if url.startswith(("sqlite:///", "postgresql://", "postgresql+asyncpg://")):
        from service.store.sql import SqlStore

        return SqlStore(url, shard)
    kind = url.partition(":")[0]  # the rest may hold a password
    raise StoreError(
        f"{kind!r} names no kind of database known here; use sqlite:///<file>, "
        "postgresql://<user>@<host>/<name> or memory:"
    )
