"""What `doctor` says of a database: each fault that can be seen without starting the service."""

from __future__ import annotations

import asyncio
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from service.cli.doctor import database
from service.settings import Settings
from service.store import SqlStore
from service.store.tables import VERSION


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "roads.db"

    async def make() -> None:
        store = SqlStore(f"sqlite:///{path}")
        await store.open()
        await store.close()

    asyncio.run(make())
    return path


def found(path: Path) -> tuple[str, str]:
    finding = database(Settings(database=f"sqlite:///{path}"))
    return finding.verdict, finding.text


def of_version(path: Path, version: str) -> None:
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("UPDATE alembic_version SET version_num = ?", (version,))
        connection.commit()


def test_one_that_is_well(path: Path) -> None:
    assert found(path) == ("ok", f"{path} can be written")
    assert found(path.with_name("new.db"))[0] == "ok"


def test_an_older_one_is_brought_up_and_a_newer_one_a_fault(path: Path) -> None:
    of_version(path, "1")
    verdict, text = found(path)
    assert verdict == "ok"
    assert f"of version 1, are brought up to {VERSION}" in text
    of_version(path, str(VERSION + 1))
    verdict, text = found(path)
    assert verdict == "fault"
    assert "newer roadtalk" in text


def test_damage_is_a_fault(path: Path) -> None:
    log = path.with_name("roads.db-wal")
    log.write_bytes(bytes(range(250)) * 40)
    assert found(path) == ("fault", f"{path} is damaged: roads.db-wal has no readable beginning")
    log.unlink()
    path.write_bytes(b"roads " * 1_000)
    verdict, text = found(path)
    assert verdict == "fault"
    assert "cannot be used" in text
