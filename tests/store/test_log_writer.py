"""The log writer: what waits together is committed together, and each entry has a fate of its own."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

import pytest

from service.store import EntryRecord, SessionRecord, SqlStore, StoredResponse, StoreError
from service.store.engines import Sqlite
from service.store.log_writer import LogWriter, PendingEntry
from service.store.sql_base import LostError

SESSIONS = [f"session-{number}" for number in range(4)]


def entry(sequence: int, **more: object) -> EntryRecord:
    return EntryRecord(sequence=sequence, tick=sequence, text=None, actions=[{"do": "undo"}], **more)  # type: ignore[arg-type]


class Commits:
    """Commits that are held until they are let go, and fail where they are told to."""

    def __init__(self) -> None:
        self.batches: list[list[str]] = []
        self.begun = asyncio.Event()
        self.let_go = asyncio.Event()
        self.faults: dict[str, list[StoreError]] = {}

    async def __call__(self, batch: Sequence[PendingEntry]) -> None:
        names = [each.session for each in batch]
        self.batches.append(names)
        self.begun.set()
        await self.let_go.wait()
        for name in names:
            if self.faults.get(name):
                raise self.faults[name].pop()


async def appended(commits: Commits) -> list[object]:
    """What becomes of an entry of each session: the first is under way when the others come."""
    log = LogWriter(commits)
    first = asyncio.create_task(log.append(SESSIONS[0], entry(1), None))
    await commits.begun.wait()
    others = [asyncio.create_task(log.append(name, entry(1), None)) for name in SESSIONS[1:]]
    await asyncio.sleep(0)
    commits.let_go.set()
    fates = await asyncio.gather(first, *others, return_exceptions=True)
    await log.finish()
    return fates


async def test_what_comes_during_a_commit_shares_the_next() -> None:
    commits = Commits()
    assert await appended(commits) == [None] * 4
    assert commits.batches == [SESSIONS[:1], SESSIONS[1:]]


async def test_a_bad_entry_fails_alone() -> None:
    commits, bad = Commits(), StoreError("bad")
    commits.faults[SESSIONS[2]] = [bad, bad]
    assert await appended(commits) == [None, None, bad, None]


async def test_a_lost_server_is_tried_once_more() -> None:
    commits, lost = Commits(), LostError("gone")
    commits.faults[SESSIONS[0]] = [lost]
    assert await appended(commits) == [None] * 4
    assert commits.batches == [SESSIONS[:1], SESSIONS[:1], SESSIONS[1:]]


async def filled(path: Path) -> list[tuple[object, ...]]:
    """The rows of a file after sessions have appended entries with names and answers, all at once."""
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    try:
        for name in SESSIONS:
            await store.create(
                SessionRecord(id=name, name=None, created_at=datetime(2026, 1, 1, tzinfo=UTC), config={})
            )
        answer = StoredResponse(key="k", request="r", at=5, status=200, headers={"a": "ü"}, body=b"\x00\xff")
        await store.append(
            SESSIONS[0], entry(1, names={"here": 1, "there": 1}, digest="d", paused=True), answer
        )
        await asyncio.gather(
            *(store.append(name, entry(2, names={"here": 2}, paused=False)) for name in SESSIONS)
        )
        assert await store.get_response("k") == answer
        assert [each.sequence for each in await store.entries(SESSIONS[0])] == [1, 2]
    finally:
        await store.close()
    with closing(sqlite3.connect(path)) as connection:
        tables = ("entries ORDER BY 1, 2", "moments ORDER BY 2, 3", "idempotency")
        return [
            tuple(value for name, value in zip(row.keys(), row, strict=True) if name != "number")
            for table in tables
            for row in _rows(connection, table)
        ]


def _rows(connection: sqlite3.Connection, table: str) -> list[sqlite3.Row]:
    connection.row_factory = sqlite3.Row
    return connection.execute(f"SELECT * FROM {table}").fetchall()


async def test_rows_are_the_same_as_those_of_sqlalchemy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    direct = await filled(tmp_path / "direct.db")

    async def unable(*_: object) -> bool:
        return False

    monkeypatch.setattr(Sqlite, "run", unable)
    assert direct == await filled(tmp_path / "other.db")
    assert len(direct) == 5 + 5 + 1


async def test_an_entry_of_an_unknown_session_leaves_nothing_open(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    try:
        with pytest.raises(StoreError, match="FOREIGN KEY"):
            await store.append("nobody", entry(1))
        assert await store.count() == 0
    finally:
        await store.close()
