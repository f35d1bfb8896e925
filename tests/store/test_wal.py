"""Damage to the log of latest changes is told, where SQLite would take it for a change never finished."""

from __future__ import annotations

import asyncio
import random
import subprocess
import sys
from pathlib import Path

import pytest

from service.store import SqlStore, StoreError
from service.store.wal import defect

KEEP_AND_DIE = """
import os, sqlite3, sys
connection = sqlite3.connect(sys.argv[1], isolation_level=None)
for pragma in ("locking_mode=EXCLUSIVE", "journal_mode=WAL", "synchronous=FULL"):
    connection.execute(f"PRAGMA {pragma}")
connection.execute("CREATE TABLE kept (number INTEGER PRIMARY KEY, text TEXT)")
for number in range(40):
    connection.execute("INSERT INTO kept VALUES (?, ?)", (number, "x" * 200))
os._exit(0)
"""
FRAME = 24 + 4096


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A database whose last changes stand in its log, as after a kill."""
    path = tmp_path / "roads.db"
    subprocess.run([sys.executable, "-c", KEEP_AND_DIE, str(path)], check=True)
    return path


def log_of(path: Path) -> Path:
    return path.with_name("roads.db-wal")


def test_a_whole_log_is_whole(path: Path, tmp_path: Path) -> None:
    assert len(log_of(path).read_bytes()) > 40 * FRAME
    assert defect(path) is None
    assert defect(tmp_path / "other.db") is None


@pytest.mark.parametrize("seed", range(8))
def test_damage_in_it_is_refused_and_everything_left_as_it_is(path: Path, seed: int) -> None:
    dice, content = random.Random(seed), bytearray(log_of(path).read_bytes())
    at = 8 if seed == 0 else dice.randrange(32, len(content) - 2 * FRAME)
    content[at : at + 16] = dice.randbytes(16)
    log_of(path).write_bytes(content)
    before = path.read_bytes()
    with pytest.raises(StoreError, match=r"damaged or none \(roads\.db-wal"):
        asyncio.run(SqlStore(f"sqlite:///{path}").open())
    assert (path.read_bytes(), log_of(path).read_bytes()) == (before, bytes(content))


def test_what_was_never_finished_is_no_damage(path: Path) -> None:
    """The last change half written, in whatever order its pages came; a beginning and no more; nothing."""
    whole = log_of(path).read_bytes()
    torn = whole[:-FRAME] + bytes(FRAME)
    longer = whole + whole[-2 * FRAME :]  # of this log by its marks, not by its sums
    for content in (whole[:-100], torn, whole[:32], whole[:20], bytes(5000), b"", longer[: -FRAME + 9]):
        log_of(path).write_bytes(content)
        assert defect(path) is None
