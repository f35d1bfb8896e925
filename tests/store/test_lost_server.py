"""A server that is lost in the midst of a commit: what nobody acknowledged is not there afterwards."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from service.store import EntryRecord, SessionRecord, SqlStore, StoredResponse, StoreError
from service.store.engines import Sqlite


class Line:
    """In place of the engine: commits, and loses the line before that is told, so many times."""

    def __init__(self, engine: Any, times: int = 0) -> None:
        self._engine = engine
        self.times = times

    @asynccontextmanager
    async def begin(self) -> AsyncIterator[Any]:
        async with self._engine.begin() as connection:
            yield connection
        if self.times:
            self.times -= 1
            raise ConnectionResetError("the line was cut")

    async def dispose(self) -> None:
        await self._engine.dispose()


RECORD = SessionRecord(id="a", name=None, created_at=datetime(2026, 1, 1, tzinfo=UTC), config={})


def entry(number: int) -> EntryRecord:
    return EntryRecord(sequence=number, tick=0, text=None, actions=[])


def under(key: str) -> StoredResponse:
    return StoredResponse(key=key, request="r", at=1, status=200, headers={}, body=b"")


@pytest.fixture
async def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[SqlStore]:
    async def none_beside_the_engine(*_: object) -> bool:
        return False

    monkeypatch.setattr(Sqlite, "run", none_beside_the_engine)  # as with a server
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    store._engine = Line(store._engine)  # type: ignore[assignment]
    yield store
    await store.close()


def cut(store: SqlStore, times: int) -> None:
    store._engine.times = times  # type: ignore[union-attr]


async def test_it_is_tried_once_more(store: SqlStore) -> None:
    await store.create(RECORD)
    await store.append("a", entry(1))
    cut(store, 1)
    await store.append("a", entry(2), under("two"))
    assert [each.sequence for each in await store.entries("a")] == [1, 2]
    assert await store.get_response("two") is not None


async def test_what_was_refused_is_taken_out(store: SqlStore) -> None:
    await store.create(RECORD)
    await store.append("a", entry(1), under("one"))
    cut(store, 2)
    with pytest.raises(StoreError, match="line was cut"):
        await store.append("a", entry(2), under("two"))
    assert await store.get_response("two") is None
    assert await store.get_response("one") is not None
    assert [each.sequence for each in await store.entries("a")] == [1]
    await store.append("a", entry(2), under("two"))
    assert [each.sequence for each in await store.entries("a")] == [1, 2]


async def test_a_session_that_was_refused_is_not_there(store: SqlStore) -> None:
    cut(store, 1)
    with pytest.raises(StoreError):
        await store.create(RECORD, [entry(1)], under("made"))
    assert (await store.get("a"), await store.get_response("made"), list(await store.newest(9))) == (
        None,
        None,
        [],
    )
    await store.create(RECORD, [entry(1)], under("made"))
    assert await store.get("a") is not None


async def test_a_number_twice_takes_nothing_out(store: SqlStore) -> None:
    await store.create(RECORD)
    await store.append("a", entry(1))
    with pytest.raises(StoreError):
        await store.append("a", entry(1))
    assert [each.sequence for each in await store.entries("a")] == [1]
