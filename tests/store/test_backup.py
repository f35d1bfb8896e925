"""A backup holds all that a store holds, is made while the store is used, and is whole or not there."""

from __future__ import annotations

import asyncio
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from alembic.config import Config
from alembic.script import ScriptDirectory

from service.store import EntryRecord, LockedError, MemoryStore, SessionRecord, SqlStore, Store, StoreError
from service.store.backup import check_backup
from service.store.base import Branch, JobRecord, PhraseRecord, SnapshotRecord, StoredResponse
from service.store.engines import database_for
from service.store.restore import NotEmptyError, restore_database
from service.store.schema import MIGRATIONS
from service.store.tables import VERSION
from service.whole_file import whole_file
from tests.support.old_databases import DATA
from tests.support.postgres import binaries, serving

ENTRY = EntryRecord(
    sequence=1, tick=3, text="add a car", actions=[{"do": "add"}], digest="d1", names={"hill": 3}
)


def record(name: str, **more: object) -> SessionRecord:
    return SessionRecord(
        id=name, name=name, created_at=datetime(2026, 1, 2, tzinfo=UTC), config={"seed": 7}, **more
    )


async def fill(store: Store) -> None:
    """One of everything."""
    await store.secret("recordings")
    await store.create(record("one"), [ENTRY])
    branch = Branch(parent="one", sequence=1, tick=3, standing="02", instead=[])
    await store.create(record("fork", branch=branch))
    await store.append("fork", replace(ENTRY, sequence=2, tick=9, names={}))
    await store.create(record("gone"), [ENTRY])
    await store.create(record("child", branch=replace(branch, parent="gone")))
    await store.delete("gone")
    when = datetime(2026, 1, 2, tzinfo=UTC)
    await store.create_job(
        JobRecord(id="j", kind="evaluation", state="running", created_at=when, spec={"runs": 3}, total=3)
    )
    await store.save_job_part("j", "p1", b"\x01", 1)
    await store.save_snapshot(
        SnapshotRecord(session="one", sequence=1, tick=3, version="1", checksum="c", body=b"\0x")
    )
    await store.save_phrase(
        PhraseRecord(owner="me", language="en", key="go", phrase="Go!", meaning=[{"do": "resume"}])
    )
    await store.save_response(
        StoredResponse(key="k", request="r", at=5, status=200, headers={"a": "b"}, body=b"{}")
    )


def names_in(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


async def contents(store: Store) -> list[object]:
    """All that can be read of a store."""
    sessions = await store.newest(100)
    return [
        sessions,
        [await store.entries(each.id) for each in sessions],
        [await store.snapshot(each.id) for each in sessions],
        await store.bookmarks(100),
        await store.phrases("me"),
        await store.get_response("k"),
        await store.secret("recordings"),
        await store.get("gone"),
    ]


async def test_a_backup_of_a_file_holds_everything(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await fill(store)
    await store.backup(tmp_path / "copy.db")
    facts = check_backup(tmp_path / "copy.db")
    assert (facts.version, facts.sessions, facts.entries) == (VERSION, 4, 3)
    expected = await contents(store)
    await store.close()
    await restore_database(tmp_path / "copy.db", f"sqlite:///{tmp_path}/other.db", replace=False)
    other = SqlStore(f"sqlite:///{tmp_path}/other.db")
    await other.open()
    assert await contents(other) == expected
    numbered = await other.create(record("new"))
    assert numbered.number == 5
    await other.close()


async def test_a_backup_of_a_store_in_memory_holds_everything(tmp_path: Path) -> None:
    store = MemoryStore()
    await fill(store)
    await store.backup(tmp_path / "copy.db")
    other = SqlStore(f"sqlite:///{tmp_path}/copy.db")
    await other.open()
    assert await contents(other) == await contents(store)
    await other.close()


async def test_a_backup_goes_from_a_file_to_a_server_and_back(tmp_path: Path) -> None:
    programs = binaries()
    if programs is None:
        pytest.skip("no PostgreSQL server is installed")
    first = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await first.open()
    await fill(first)
    expected = await contents(first)
    await first.backup(tmp_path / "file.db")
    await first.close()
    with serving(programs) as running:
        url = await running.database()
        facts, kept = await restore_database(tmp_path / "file.db", url, replace=False)
        assert (facts.sessions, kept) == (4, None)
        with pytest.raises(NotEmptyError, match="holds sessions already"):
            await restore_database(tmp_path / "file.db", url, replace=False)
        await restore_database(tmp_path / "file.db", url, replace=True)
        second = SqlStore(url)
        await second.open()
        assert await contents(second) == expected
        assert (await second.create(record("new"))).number == 5
        with pytest.raises(StoreError, match="locked"):
            await restore_database(tmp_path / "file.db", url, replace=True)
        await second.backup(tmp_path / "server.db")
        expected = await contents(second)
        await second.close()
    third = SqlStore(f"sqlite:///{tmp_path}/server.db")
    await third.open()
    assert await contents(third) == expected
    await third.close()


async def test_changes_go_on_while_a_backup_is_made_and_are_in_it_in_order(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.create(record("one"))
    for sequence in range(1, 201):
        await store.append("one", replace(ENTRY, sequence=sequence, text="x" * 8_000, names={}))
    copying = asyncio.ensure_future(store.backup(tmp_path / "copy.db"))
    during = 0
    while not copying.done():
        during += 1
        await store.append("one", replace(ENTRY, sequence=200 + during, text="y" * 8_000, names={}))
    await copying
    await store.close()
    check_backup(tmp_path / "copy.db")
    copy = SqlStore(f"sqlite:///{tmp_path}/copy.db")
    await copy.open()
    sequences = [entry.sequence for entry in await copy.entries("one")]
    await copy.close()
    assert during >= 2
    assert sequences == list(range(1, len(sequences) + 1))
    assert len(sequences) >= 200


async def test_a_store_that_closes_ends_a_backup(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.create(record("one"))
    for sequence in range(1, 401):
        await store.append("one", replace(ENTRY, sequence=sequence, text="x" * 8_000, names={}))
    copying = asyncio.ensure_future(store.backup(tmp_path / "copy.db"))
    await asyncio.sleep(0)
    await store.close()
    with pytest.raises(StoreError, match="The service stops"):
        await copying


async def test_what_is_restored_counts_as_used_now(tmp_path: Path) -> None:
    store = MemoryStore()
    await fill(store)
    await store.backup(tmp_path / "copy.db")
    await restore_database(tmp_path / "copy.db", f"sqlite:///{tmp_path}/roads.db", replace=False)
    restored = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await restored.open()
    await restored.create(replace(record("old"), created_at=datetime.now(UTC) - timedelta(days=99)))
    found = await restored.unused(datetime.now(UTC) - timedelta(days=1), 9, named=True)
    await restored.close()
    assert list(found) == ["old"]


async def test_a_restore_refuses_what_is_there_and_keeps_what_it_replaces(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.create(record("old"))
    await store.close()
    new = MemoryStore()
    await fill(new)
    await new.backup(tmp_path / "copy.db")
    url = f"sqlite:///{tmp_path}/roads.db"
    with pytest.raises(NotEmptyError):
        await restore_database(tmp_path / "copy.db", url, replace=False)
    _, kept = await restore_database(tmp_path / "copy.db", url, replace=True)
    assert kept is not None
    for path, names in ((tmp_path / "roads.db", ["child", "fork", "one"]), (kept, ["old"])):
        store = SqlStore(f"sqlite:///{path}")
        await store.open()
        assert [each.name for each in await store.newest(9)] == names
        await store.close()


async def test_a_database_in_use_is_not_replaced(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.backup(tmp_path / "copy.db")
    with pytest.raises(LockedError):
        await restore_database(tmp_path / "copy.db", f"sqlite:///{tmp_path}/roads.db", replace=True)
    with pytest.raises(LockedError):
        await database_for(f"sqlite:///{tmp_path}/roads.db").copy(tmp_path / "other.db")
    await store.close()


@pytest.mark.parametrize("damage", ["cut", "flipped", "text", "newer", "foreign"])
async def test_what_is_no_whole_backup_is_refused_and_nothing_is_touched(tmp_path: Path, damage: str) -> None:
    store = MemoryStore()
    await fill(store)
    for number in range(200):
        await store.create(record(f"more {number}"), [replace(ENTRY, text="x" * 500, names={})])
    backup = tmp_path / "copy.db"
    await store.backup(backup)
    data = bytearray(backup.read_bytes())
    match damage:
        case "cut":
            backup.write_bytes(data[: len(data) // 2])
        case "flipped":
            for at in range(len(data) // 2, len(data) // 2 + 3_000):
                data[at] ^= 0xFF
            backup.write_bytes(data)
        case "text":
            backup.write_text("no database at all, but long enough to be looked at " * 20)
        case "newer":
            with closing(sqlite3.connect(backup)) as connection, connection:
                connection.execute("UPDATE alembic_version SET version_num = '99'")
        case "foreign":
            backup.unlink()
            with closing(sqlite3.connect(backup)) as connection, connection:
                connection.execute("CREATE TABLE birds (name)")
    with pytest.raises(StoreError, match=r"copy\.db"):
        await restore_database(backup, f"sqlite:///{tmp_path}/roads.db", replace=True)
    assert names_in(tmp_path) == ["copy.db"]


async def test_a_database_of_an_old_version_is_copied_as_it_is(tmp_path: Path) -> None:
    shutil.copy(DATA / "version3.sqlite", tmp_path / "roads.db")
    await database_for(f"sqlite:///{tmp_path}/roads.db").copy(tmp_path / "copy.db")
    assert check_backup(tmp_path / "copy.db").version == 3
    assert check_backup(tmp_path / "copy.db").sessions == 3


KILLED = """
import sqlite3, sys, time
from pathlib import Path
from service.whole_file import whole_file
with whole_file(Path(sys.argv[1]), replace=True) as file:
    file.write(b"half")
    file.flush()
    print("writing", flush=True)
    time.sleep(60)
"""


def test_a_kill_leaves_no_half_file_under_the_name(tmp_path: Path) -> None:
    path = tmp_path / "copy.db"
    path.write_bytes(b"the last one")
    process = subprocess.Popen([sys.executable, "-c", KILLED, str(path)], stdout=subprocess.PIPE)
    assert process.stdout is not None
    assert process.stdout.readline() == b"writing\n"
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    process.stdout.close()
    assert path.read_bytes() == b"the last one"


async def test_what_a_killed_service_left_half_made_is_removed(tmp_path: Path) -> None:
    (tmp_path / ".roads.db.abc.partial").write_bytes(b"half")
    (tmp_path / ".others.db.abc.partial").write_bytes(b"not ours")
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    await store.close()
    assert names_in(tmp_path) == [".others.db.abc.partial", "roads.db"]


def test_a_file_is_not_written_over_unless_that_is_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "copy.db"
    path.write_bytes(b"old")
    with pytest.raises(FileExistsError), whole_file(path):
        pass
    with whole_file(path, replace=True) as file:
        file.write(b"new")
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]


def test_every_version_of_the_database_has_an_upgrade_note() -> None:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    config.set_main_option("path_separator", "os")
    versions = {each.revision for each in ScriptDirectory.from_config(config).walk_revisions()}
    notes = (Path(__file__).parents[2] / "docs" / "how-to" / "upgrade.md").read_text()
    assert {version for version in versions if f"\n| {version} |" in notes} == versions
