"""A file that another program holds: who that is, where it can be known."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from service.store import SqlStore, StoreError
from service.store import lock_owner as holders

HOLD = """
import sqlite3, sys
connection = sqlite3.connect(sys.argv[-1], isolation_level=None)
connection.execute("BEGIN EXCLUSIVE")
print("held", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def held(tmp_path: Path) -> Iterator[tuple[Path, int]]:
    """A file, and the process that holds it."""
    path = tmp_path / "roads.db"
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    assert process.stdin is not None
    assert process.stdout is not None
    assert process.stdout.readline() == b"held\n"
    yield path, process.pid
    process.stdin.close()
    process.stdout.close()
    process.wait()


async def refusal(path: Path) -> str:
    with pytest.raises(StoreError) as raised:
        await SqlStore(f"sqlite:///{path}").open()
    return str(raised.value)


async def test_who_holds_it_is_named_where_the_system_tells(held: tuple[Path, int]) -> None:
    path, process = held
    said = await refusal(path)
    assert said.startswith(f"The database {path} cannot be opened: it is locked: ")
    assert said.endswith("Stop that one, or name another file in ROADTALK_DATABASE.")
    if holders.holder(path) is None:
        assert "perhaps another Roadtalk service" in said
    else:
        assert f"another program (process {process}) has it open" in said


async def test_where_it_does_not_nobody_is_named(
    held: tuple[Path, int], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(holders, "_LOCKS", tmp_path / "none")
    said = await refusal(held[0])
    assert "another program, perhaps another Roadtalk service, has it open." in said
    assert str(held[1]) not in said.replace(str(held[0]), "")


def test_only_who_holds_it_is_taken_from_the_list(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path, locks = tmp_path / "roads.db", tmp_path / "locks"
    path.touch()
    about = path.stat()
    name = f"{os.major(about.st_dev):02x}:{os.minor(about.st_dev):02x}:{about.st_ino}"
    locks.write_text(
        f"1: POSIX  ADVISORY  WRITE 11 {name}1 0 EOF\n"
        f"2: -> POSIX  ADVISORY  WRITE 12 {name} 0 EOF\n"
        f"3: POSIX  ADVISORY  WRITE 0 {name} 0 EOF\n"
        "nothing at all\n"
        f"4: POSIX  ADVISORY  WRITE 13 {name} 0 EOF\n"
    )
    monkeypatch.setattr(holders, "_LOCKS", locks)
    assert holders.holder(path) == 13
    assert holders.holder(tmp_path / "another.db") is None
    locks.write_text(f"1: POSIX  ADVISORY  WRITE {os.getpid()} {name} 0 EOF\n")
    assert "this service has it open already" in holders.told(path)


def test_a_service_is_called_one() -> None:
    waiting = "import sys; print('ready', flush=True); sys.stdin.read()"
    for more, who in (
        (["-m", "service", "serve"], "another Roadtalk service"),
        (["-m", "service", "doctor"], "another Roadtalk program"),
        (["serve"], "another program"),
    ):
        with subprocess.Popen(
            [sys.executable, "-c", waiting, *more], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        ) as process:
            assert process.stdout is not None
            assert process.stdout.readline() == b"ready\n"
            assert holders._who(process.pid) in (who, "another program")
            if Path(f"/proc/{process.pid}/cmdline").exists():
                assert holders._who(process.pid) == who
