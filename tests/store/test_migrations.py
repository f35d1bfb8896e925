"""Databases of older versions are brought up, those of newer ones refused; recordings of all are replayed."""

from __future__ import annotations

import json
import shutil
import sqlite3
from pathlib import Path

import httpx
import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory

from service.app import create_app
from service.settings import Settings
from service.store import SqlStore, StoreError
from service.store.schema import MIGRATIONS
from service.store.tables import METADATA, VERSION
from tests.support.old_databases import DATA, state_of


def version(path: Path) -> str:
    connection = sqlite3.connect(path)
    try:
        return str(connection.execute("SELECT version_num FROM alembic_version").fetchone()[0])
    finally:
        connection.close()


def test_the_version_is_that_of_the_last_migration() -> None:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    config.set_main_option("path_separator", "os")
    assert ScriptDirectory.from_config(config).get_heads() == [str(VERSION)]


async def test_the_migrations_end_in_the_tables_of_the_code(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    async with store._transaction() as connection:
        differences = await connection.run_sync(
            lambda sync: compare_metadata(MigrationContext.configure(sync), METADATA)
        )
    await store.close()
    assert differences == []


@pytest.mark.parametrize(("old", "sessions"), [(1, 2), (3, 3)])
async def test_a_database_of_an_old_version_is_brought_up(tmp_path: Path, old: int, sessions: int) -> None:
    """Written by the code of that time; every session ends where it then stood."""
    path = tmp_path / "roads.db"
    shutil.copy(DATA / f"version{old}.sqlite", path)
    known = json.loads((DATA / f"version{old}.json").read_text())
    assert len(known) == sessions
    for session, stood in known.items():
        state = (await state_of(f"sqlite:///{path}", session)).json()
        assert {key: state[key] for key in stood} == stood
    assert version(path) == str(VERSION)


async def test_a_name_given_in_version_3_is_listed(tmp_path: Path) -> None:
    path = tmp_path / "roads.db"
    shutil.copy(DATA / "version3.sqlite", path)
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    found = [(each.name, each.session_name, each.sequence, each.tick) for each in await store.bookmarks(9)]
    branches = [each.branch for each in await store.newest(9)]
    await store.close()
    assert found == [("hill", "road 7", 3, 9)]
    assert branches == [None, None, None]


@pytest.mark.parametrize(
    ("name", "checked"),
    [("recording-7", 0), ("recording-11", 0), ("recording-13", 11), ("recording-fork", 4)],
)
async def test_old_recordings_are_replayed(name: str, checked: int) -> None:
    """Those of before entries named their digests, and since then."""
    recording = json.loads((DATA / f"{name}.json").read_text())
    assert sum("digest" in entry for entry in recording["entries"]) == checked
    app = create_app(Settings(database="memory:"))
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        made = await client.post("/api/v1/sessions", json={"recording": recording, "paused": True})
        assert made.status_code == 201, made.text
        state = (await client.get(f"{made.headers['location']}/state")).json()
    assert (state["digest"], state["tick"]) == (recording["digest"], recording["tick"])


@pytest.mark.parametrize("newer", ["4711", "of the future"])
async def test_a_newer_database_is_refused_and_left_alone(tmp_path: Path, newer: str) -> None:
    path = tmp_path / "roads.db"
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    await store.close()
    connection = sqlite3.connect(path)
    connection.execute("UPDATE alembic_version SET version_num = ?", (newer,))
    connection.commit()
    connection.close()

    with pytest.raises(StoreError, match=f"newer roadtalk; this one knows versions up to {VERSION}"):
        await store.open()
    assert version(path) == newer


async def test_a_migration_that_fails_leaves_the_old_version(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of it or nothing, also of several versions at once."""
    path = tmp_path / "roads.db"
    shutil.copy(DATA / "version1.sqlite", path)
    connection = sqlite3.connect(path)
    before = connection.execute("SELECT name FROM sqlite_master ORDER BY name").fetchall()
    connection.close()

    def fail(*_: object, **__: object) -> None:
        raise OSError("the power went")

    with monkeypatch.context() as patch:
        patch.setattr("alembic.op.add_column", fail)
        with pytest.raises(StoreError, match="the power went"):
            await SqlStore(f"sqlite:///{path}").open()

    connection = sqlite3.connect(path)
    assert connection.execute("SELECT name FROM sqlite_master ORDER BY name").fetchall() == before
    connection.close()
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    await store.close()
    assert version(path) == str(VERSION)


async def test_another_end_than_once_names_the_entry(tmp_path: Path) -> None:
    """As when the rules were changed, or somebody wrote in the file."""
    path = tmp_path / "roads.db"
    app = create_app(Settings(database=f"sqlite:///{path}"))
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        made = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
        for text in ("add a pothole", "step 3", "add a pedestrian"):
            assert (await client.post(f"{made.headers['location']}/commands", json={"text": text})).is_success
    connection = sqlite3.connect(path)
    digests = [row[0] for row in connection.execute("SELECT digest FROM entries ORDER BY sequence")]
    assert len(set(digests)) == 3
    assert {len(digest) for digest in digests} == {32}
    connection.execute("UPDATE entries SET digest = ? WHERE sequence = 2", ("0" * 32,))
    connection.commit()
    connection.close()

    answer = await state_of(f"sqlite:///{path}", made.json()["id"])
    assert (answer.status_code, answer.json()["type"]) == (503, "/problems/not-restorable")
    assert "entry 2" in answer.json()["detail"]


async def test_names_given_before_version_4_are_listed(tmp_path: Path) -> None:
    """Each with the latest moment it was given to, at the tick that time stood at by then."""
    path = tmp_path / "roads.db"
    shutil.copy(DATA / "version1.sqlite", path)
    connection = sqlite3.connect(path)
    (session,) = connection.execute("SELECT id FROM sessions ORDER BY number LIMIT 1").fetchone()
    said = [
        (901, 40, [{"do": "save", "name": "hill"}]),
        (902, 50, [{"do": "step", "ticks": 3}, {"do": "save", "name": "dale"}]),
        (
            903,
            60,
            [{"do": "load", "name": "dale"}, {"do": "rewind", "ticks": 2}, {"do": "save", "name": "hill"}],
        ),
    ]
    for sequence, tick, actions in said:
        row = (session, sequence, tick, None, json.dumps(actions))
        connection.execute(
            "INSERT INTO entries (session_id, sequence, tick, text, actions) VALUES (?, ?, ?, ?, ?)", row
        )
    connection.commit()
    connection.close()
    store = SqlStore(f"sqlite:///{path}")
    await store.open()
    found = [(each.name, each.sequence, each.tick) for each in await store.bookmarks(9)]
    await store.close()
    assert found == [("hill", 903, 51), ("dale", 902, 53)]
