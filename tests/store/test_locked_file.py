"""A database file that another program holds is refused."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from service.store import SqlStore, StoreError

HOLD = """
import sqlite3, sys
connection = sqlite3.connect(sys.argv[-1], isolation_level=None)
connection.execute("BEGIN EXCLUSIVE")
print("held", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def held(tmp_path: Path) -> Iterator[Path]:
    """A file that another process holds."""
    path = tmp_path / "roads.db"
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    assert process.stdin is not None
    assert process.stdout is not None
    assert process.stdout.readline() == b"held\n"
    yield path
    process.stdin.close()
    process.stdout.close()
    process.wait()


async def test_a_locked_file_is_refused_with_what_to_do(held: Path) -> None:
    with pytest.raises(StoreError) as raised:
        await SqlStore(f"sqlite:///{held}").open()
    refusal = str(raised.value)
    assert refusal.startswith(f"The database {held} cannot be opened: it is locked: ")
    assert "perhaps another Roadtalk service" in refusal
    assert refusal.endswith("Stop that one, or name another file in ROADTALK_DATABASE.")
