"""One suite for every store, then what only the file can show."""

from __future__ import annotations

import asyncio
import socket
import sqlite3
import subprocess
import sys
from collections.abc import AsyncIterator
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import asyncpg
import pytest

from service.sharding import Shard
from service.store import (
    Branch,
    EntryRecord,
    MemoryStore,
    SessionRecord,
    SnapshotRecord,
    SqlStore,
    Store,
    StoreError,
    open_store,
)
from service.store.fork_log import encode_standing
from tests.support.postgres import Server

MOMENT = datetime(2026, 3, 29, 1, 30, 15, 250_000, tzinfo=UTC)


def record(name: str, **more: object) -> SessionRecord:
    return replace(
        SessionRecord(
            id=name, name=f"road {name}", created_at=MOMENT, config={"seed": 2**53 - 1, "road": None}
        ),
        **more,
    )


def entry(sequence: int, tick: int = 3) -> EntryRecord:
    actions = [{"do": "add", "kind": "pothole", "count": 2, "where": {"cell": [1, 2]}}]
    return EntryRecord(
        sequence=sequence, tick=tick, text="zwei Schlaglöcher ✓", actions=actions, digest=f"{sequence:032x}"
    )


async def opened_store(kind: str, request: pytest.FixtureRequest, folder: Path) -> Store:
    if kind == "memory":
        return MemoryStore()
    if kind == "sqlite":
        return SqlStore(f"sqlite:///{folder}/roads.db")
    return SqlStore(await request.getfixturevalue("postgres").database())


@pytest.fixture(params=["memory", "sqlite", "postgres"])
async def store(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[Store]:
    opened = await opened_store(request.param, request, tmp_path)
    await opened.open()
    yield opened
    await opened.close()


async def test_what_was_kept_comes_back_the_same(store: Store) -> None:
    kept = await store.create(record("a"), [entry(1)])
    await store.append("a", entry(2, tick=9))

    assert await store.get("a") == kept
    assert (kept.created_at, kept.config, kept.tick) == (MOMENT, {"seed": 2**53 - 1, "road": None}, 0)
    assert list(await store.entries("a")) == [entry(1), entry(2, tick=9)]


async def test_it_outlives_closing(store: Store) -> None:
    await store.create(record("a"))
    await store.append("a", entry(1))
    await store.close()
    await store.close()
    await store.open()
    await store.open()

    assert list(await store.entries("a")) == [entry(1)]


async def test_pages_go_from_the_newest_back(store: Store) -> None:
    numbers = [(await store.create(record(name))).number for name in "abcde"]

    assert numbers == sorted(set(numbers))
    assert [found.id for found in await store.newest(2)] == ["e", "d"]
    assert [found.id for found in await store.newest(9, before=numbers[3])] == ["c", "b", "a"]
    assert list(await store.newest(9, before=numbers[0])) == []


async def test_it_counts_what_can_be_seen(store: Store) -> None:
    assert await store.count() == 0
    for name in "abc":
        await store.create(record(name))
    await store.create(record("d", branch=branch("a", 0)))
    await store.delete("a")
    await store.delete("b")
    assert await store.count() == 2


async def test_a_sequence_is_taken_once(store: Store) -> None:
    await store.create(record("a"))
    await store.append("a", entry(1))

    with pytest.raises(StoreError):
        await store.append("a", replace(entry(1), text="another"))
    assert list(await store.entries("a")) == [entry(1)]


async def test_unknown_sessions_hold_nothing(store: Store) -> None:
    with pytest.raises(StoreError):
        await store.append("nobody", entry(1))
    await store.save_ticks({"nobody": 5})
    assert await store.get("nobody") is None
    assert list(await store.entries("nobody")) == []
    assert await store.delete("nobody") is False


async def test_the_longest_unused_are_found_first_and_named_ones_apart(store: Store) -> None:
    for each in ("a", "b", "d"):
        await store.create(replace(record(each), name=None))
    await store.create(record("c"))
    await store.append("d", replace(entry(1), names={"here": 3}))
    assert list(await store.unused(MOMENT + timedelta(days=9), 9, named=True)) == []  # none was used since
    await store.create(record("live"))
    await store.touch(["live", "nobody"], MOMENT + timedelta(days=9))
    await store.touch(["a"], MOMENT + timedelta(days=1))
    since = MOMENT + timedelta(days=5)
    assert list(await store.unused(since, 9, named=False)) == ["b", "a"]
    assert list(await store.unused(since, 1, named=False)) == ["b"]
    assert set(await store.unused(since, 9, named=True)) == {"a", "b", "c", "d"}
    await store.save_ticks({"b": 7})
    await store.delete("a")
    assert list(await store.unused(since, 9, named=False)) == []


async def test_a_session_is_made_once(store: Store) -> None:
    await store.create(record("a"))
    with pytest.raises(StoreError):
        await store.create(record("a"), [entry(1)])
    assert list(await store.entries("a")) == []


async def test_deleting_forgets_the_changes_too(store: Store) -> None:
    await store.create(record("a"), [entry(1)])
    assert await store.delete("a") is True
    assert await store.get("a") is None
    await store.create(record("a"))
    assert list(await store.entries("a")) == []


async def test_numbers_are_never_given_twice(store: Store) -> None:
    first = await store.create(record("a"))
    await store.delete("a")
    assert (await store.create(record("b"))).number > first.number


def branch(parent: str, sequence: int) -> Branch:
    instead = [{"sequence": 2, "tick": 9, "actions": entry(2).actions}]
    return Branch(
        parent=parent, sequence=sequence, tick=9, standing=encode_standing([1, 4], sequence), instead=instead
    )


async def test_a_fork_begins_with_what_stands_of_its_parent(store: Store) -> None:
    await store.create(record("a"), [entry(number) for number in range(1, 7)])
    kept = await store.create(record("b", branch=branch("a", 4)))
    await store.append("b", entry(5, tick=11))
    assert await store.get("b") == kept
    unsaid = [replace(entry(1), text=None), replace(entry(2, tick=9), text=None, digest=None)]
    both = [*unsaid, replace(entry(4), text=None), entry(5, tick=11)]
    assert list(await store.entries("b")) == both
    await store.create(record("c", branch=branch("b", 5)))
    again = replace(entry(2, tick=9), text=None, digest=None)
    assert list(await store.entries("c")) == [unsaid[0], again, replace(entry(4), text=None)]
    with pytest.raises(StoreError):
        await store.create(record("d", branch=branch("nobody", 4)))
    assert await store.get("d") is None


async def test_a_parent_is_kept_unseen_for_its_forks(store: Store) -> None:
    await store.create(record("a"), [entry(number) for number in range(1, 7)])
    await store.create(record("b", branch=branch("a", 4)))
    await store.create(record("c", branch=branch("b", 4)))
    log = list(await store.entries("c"))
    assert await store.delete("a") is True
    assert await store.delete("a") is False
    assert await store.delete("b") is True
    assert await store.get("a") is None
    assert list(await store.entries("a")) == []
    assert [each.id for each in await store.newest(5)] == ["c"]
    assert list(await store.entries("c")) == log
    with pytest.raises(StoreError):
        await store.append("a", entry(7))
    assert await store.delete("c") is True
    await store.create(record("a"))  # nothing of it is left
    assert list(await store.entries("a")) == []


def snapshot(name: str, sequence: int, body: bytes = b"\x00\xff\x80 worlds") -> SnapshotRecord:
    return SnapshotRecord(
        session=name, sequence=sequence, tick=9, version="1.ab", checksum=f"{sequence:032x}", body=body
    )


async def test_the_latest_snapshot_of_a_session_is_kept(store: Store) -> None:
    await store.create(record("a"), [entry(1)])
    await store.create(record("b"), [entry(1)])
    assert await store.snapshot("a") is None
    await store.save_snapshot(snapshot("a", 1))
    await store.save_snapshot(snapshot("a", 2, bytes(range(256)) * 999))
    await store.save_snapshot(snapshot("b", 1))
    assert await store.snapshot("a") == snapshot("a", 2, bytes(range(256)) * 999)
    assert await store.snapshot("b") == snapshot("b", 1)
    await store.save_snapshot(snapshot("nobody", 1))
    assert await store.snapshot("nobody") is None


async def test_a_snapshot_goes_with_its_session_also_where_a_fork_needs_the_log(store: Store) -> None:
    await store.create(record("a"), [entry(number) for number in range(1, 7)])
    await store.create(record("b", branch=branch("a", 4)))
    for name in "ab":
        await store.save_snapshot(snapshot(name, 6))
    await store.delete("a")
    assert await store.snapshot("a") is None
    await store.save_snapshot(snapshot("a", 7))
    assert await store.snapshot("a") is None, "one that was still being made"
    await store.delete("b")
    assert await store.snapshot("b") is None


async def test_whether_time_stood_still_is_kept_where_it_is_said(store: Store) -> None:
    said = [replace(entry(number), paused=paused) for number, paused in ((1, True), (2, False), (3, None))]
    await store.create(record("a"), said[:1])
    for each in said[1:]:
        await store.append("a", each)
    assert list(await store.entries("a")) == said


async def test_named_moments_of_all_sessions(store: Store) -> None:
    await store.create(record("a"), [replace(entry(1), names={"hill": 3, "dale": 4})])
    await store.create(record("b"))
    await store.append("b", replace(entry(1), names={"hill": 7}))
    await store.append("a", replace(entry(2), names={"dale": 9}))
    found = await store.bookmarks(9)
    assert [(each.session, each.session_name, each.name, each.sequence, each.tick) for each in found] == [
        ("a", "road a", "dale", 2, 9),
        ("b", "road b", "hill", 1, 7),
        ("a", "road a", "hill", 1, 3),
    ]
    assert [each.tick for each in await store.bookmarks(1, before=found[0].number)] == [7]
    assert [each.session for each in await store.bookmarks(9, name="hill")] == ["b", "a"]
    await store.delete("b")
    assert [each.session for each in await store.bookmarks(9)] == ["a", "a"]


async def test_ticks_are_remembered(store: Store) -> None:
    for name in "ab":
        await store.create(record(name))
    await store.save_ticks({"a": 41, "b": 7})
    found = {each.id: each.tick for each in await store.newest(5)}
    assert found == {"a": 41, "b": 7}


async def test_many_at_once_each_get_their_own_answer(store: Store) -> None:
    """A bad entry among good ones written together fails alone."""
    await store.create(record("a"))
    await store.append("a", entry(5))

    outcomes = await asyncio.gather(
        *(store.append("a", entry(sequence)) for sequence in range(1, 11)), return_exceptions=True
    )

    failed = [
        sequence for sequence, outcome in enumerate(outcomes, start=1) if isinstance(outcome, StoreError)
    ]
    assert failed == [5]
    assert [kept.sequence for kept in await store.entries("a")] == list(range(1, 11))


async def test_the_file_waits_for_the_disk_and_keeps_one_connection(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    async with store._transaction() as connection:
        pragmas = {
            name: (await connection.exec_driver_sql(f"PRAGMA {name}")).scalar_one()
            for name in ("journal_mode", "synchronous", "foreign_keys", "locking_mode")
        }
    await store.close()
    assert pragmas == {
        "journal_mode": "wal",
        "synchronous": 2,
        "foreign_keys": 1,
        "locking_mode": "exclusive",
    }


async def test_a_second_process_is_refused(tmp_path: Path) -> None:
    """Two services on one file would each believe they own its sessions."""
    path = tmp_path / "roads.db"
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    code = (
        "import asyncio, sys; from service.store import SqlStore, StoreError\n"
        "try: asyncio.run(SqlStore(sys.argv[1]).open())\n"
        "except StoreError as error: print(error)"
    )
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", code, f"sqlite:///{path}", stdout=subprocess.PIPE
    )
    said, _ = await process.communicate()
    await store.close()
    assert b"cannot be opened" in said
    assert b"locked" in said


async def test_a_file_that_is_no_database_is_told(tmp_path: Path) -> None:
    (tmp_path / "roads.db").write_bytes(b"this is not a database at all" * 100)
    with pytest.raises(StoreError, match="cannot be opened"):
        await SqlStore(f"sqlite:///{tmp_path}/roads.db").open()
    with pytest.raises(StoreError, match="cannot be opened"):
        await SqlStore(f"sqlite:///{tmp_path}/no/such/folder/roads.db").open()


async def test_a_closed_store_says_so(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="not open"):
        await SqlStore(f"sqlite:///{tmp_path}/roads.db").get("a")


async def test_a_second_service_on_the_same_server_is_refused(postgres: Server) -> None:
    url = await postgres.database()
    first, second = SqlStore(url), SqlStore(url)
    await first.open()
    with pytest.raises(StoreError, match="locked: another service uses it"):
        await second.open()
    await first.close()
    await second.open()
    await second.close()


async def test_shards_share_a_server_and_nobody_else_does(postgres: Server) -> None:
    url = await postgres.database()
    alone, again = SqlStore(url), SqlStore(url, Shard(1, 2))
    shards = [SqlStore(url, Shard(number, 2)) for number in range(2)]
    for each in shards:
        await each.open()
    for refused in (alone, again):  # a service of its own, and a second process of one number
        with pytest.raises(StoreError, match="locked: another service uses it"):
            await refused.open()
    await shards[1].close()
    await again.open()
    for each in (shards[0], again):
        await each.close()
    await alone.open()
    with pytest.raises(StoreError, match="locked: another service uses it"):
        await shards[0].open()
    await alone.close()


async def test_a_server_that_is_not_there_is_told_without_a_password() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        store = SqlStore(f"postgresql://me:hunter2@127.0.0.1:{free.getsockname()[1]}/roads")
        with pytest.raises(
            StoreError, match=r"The database roads on 127\.0\.0\.1 cannot be opened"
        ) as caught:
            await store.open()
    assert "hunter2" not in str(caught.value)


async def test_a_lost_connection_is_made_again(postgres: Server) -> None:
    """A change is tried once more, so it is kept, and once; the server is gone by then, or going."""
    name = (url := await postgres.database()).rpartition("/")[2]
    store = SqlStore(url)
    await store.open()
    await store.create(record("a"), [entry(1)])
    for sequence, gone in ((2, "pid, 5000"), (3, "pid")):
        await postgres.execute(
            name,
            f"SELECT pg_terminate_backend({gone}) FROM pg_stat_activity "
            f"WHERE application_name = 'roadtalk' AND datname = '{name}'",
        )
        await store.append("a", entry(sequence))
    kept = list(await store.entries("a"))
    await store.close()
    assert kept == [entry(1), entry(2), entry(3)]


async def test_a_table_locked_by_another_is_told_in_time(postgres: Server) -> None:
    url = await postgres.database()
    store = SqlStore(url)
    await store.open()
    await store.create(record("a"))
    other = await asyncpg.connect(url)
    async with other.transaction():
        await other.execute("LOCK TABLE entries IN ACCESS EXCLUSIVE MODE")
        with pytest.raises(StoreError, match="lock timeout"):
            await store.append("a", entry(1))
    await other.close()
    await store.append("a", entry(1))
    assert list(await store.entries("a")) == [entry(1)]
    await store.close()


def test_urls_name_stores() -> None:
    assert isinstance(open_store("postgresql+asyncpg://me:secret@here/roads"), SqlStore)
    assert isinstance(open_store("memory:"), MemoryStore)
    assert isinstance(open_store("sqlite:///x.db"), SqlStore)
    with pytest.raises(StoreError, match="mongodb"):
        open_store("mongodb://here")


async def test_the_file_is_plain_sqlite(tmp_path: Path) -> None:
    """Anyone can look into it with any tool once the service has stopped."""
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.create(record("a"), [entry(1)])
    await store.close()
    with sqlite3.connect(tmp_path / "roads.db") as connection:
        assert connection.execute("SELECT id, tick FROM sessions").fetchall() == [("a", 0)]
        assert connection.execute("SELECT sequence, tick FROM entries").fetchall() == [(1, 3)]
    connection.close()


async def test_a_session_gets_another_name_and_loses_it(store: Store) -> None:
    await store.create(record("a"))
    assert await store.rename("a", "Rush hour")
    found = await store.get("a")
    assert found is not None
    assert found.name == "Rush hour"
    assert await store.rename("a", None)
    found = await store.get("a")
    assert found is not None
    assert found.name is None
    assert not await store.rename("b", "nobody")
    await store.delete("a")
    assert not await store.rename("a", "gone")
