"""`roadtalk backup` and `restore`, with and without a running service."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from typer.testing import CliRunner, Result

from service.cli.main import cli
from service.store import SqlStore
from tests.support.old_databases import DATA
from tests.support.service_process import ServiceProcess


def run(*arguments: object, **environment: str) -> Result:
    return CliRunner().invoke(cli, [str(each) for each in arguments], env=environment)


def states(url: str, sessions: list[str]) -> list[tuple[int, str]]:
    found = [httpx.get(f"{url}/api/v1/sessions/{each}/state", timeout=60).json() for each in sessions]
    return [(each["sequence"], each["digest"]) for each in found]


@pytest.fixture
def running(tmp_path: Path) -> Iterator[ServiceProcess]:
    process = ServiceProcess(tmp_path / "roads.db")
    process.start()
    yield process
    process.kill()


def test_a_backup_of_a_running_service_is_restored_after_a_kill(
    running: ServiceProcess, tmp_path: Path
) -> None:
    sessions = [running.session(seed=seed, paused=True) for seed in (7, 11)]
    for each in sessions:
        body = {"actions": [{"do": "add", "kind": "barrier", "count": 3}]}
        httpx.post(f"{running.url}/api/v1/sessions/{each}/actions", json=body, timeout=60).raise_for_status()
    expected = states(running.url, sessions)
    copy, database = tmp_path / "copy.db", f"sqlite:///{tmp_path}/roads.db"
    port = running.url.rpartition(":")[2]

    done = run("backup", copy, "--database", database, ROADTALK_PORT=port)
    assert done.exit_code == 0, done.output
    assert f"{copy}: 2 sessions, 2 changes, version " in done.output
    assert "is there already" in run("backup", copy, "--database", database, ROADTALK_PORT=port).output
    assert run("backup", copy, "--url", running.url, "--force").exit_code == 0
    other = run("backup", tmp_path / "no.db", "--database", f"sqlite:///{tmp_path}/gone/x.db")
    assert other.exit_code == 1
    refused = run("restore", copy, "--database", database, "--force")
    assert refused.exit_code == 1
    assert "locked" in refused.output

    running.kill()
    (tmp_path / "roads.db").write_bytes(b"damaged " * 1_000)
    refused = run("restore", copy, "--database", database)
    assert refused.exit_code == 1
    assert "Use --force" in refused.output
    restored = run("restore", copy, "--database", database, "--force")
    assert restored.exit_code == 0, restored.output
    assert "What was there before is kept: " in restored.output
    running.start()
    assert states(running.url, sessions) == expected
    names = sorted(each.name for each in tmp_path.iterdir())
    assert not [each for each in names if each.endswith(".partial")]


def test_a_service_of_another_database_is_not_taken_for_the_one_that_was_meant(
    running: ServiceProcess, tmp_path: Path
) -> None:
    async def held() -> Result:
        store = SqlStore(f"sqlite:///{tmp_path}/held.db")
        await store.open()
        try:
            port = running.url.rpartition(":")[2]
            arguments = ("backup", tmp_path / "copy.db", "--database", f"sqlite:///{tmp_path}/held.db")
            return await asyncio.to_thread(run, *arguments, ROADTALK_PORT=port)
        finally:
            await store.close()

    done = asyncio.run(held())
    assert done.exit_code == 1
    assert "uses another database" in done.output
    assert not (tmp_path / "copy.db").exists()


def test_without_a_service_the_database_itself_is_copied(tmp_path: Path) -> None:
    shutil.copy(DATA / "version3.sqlite", tmp_path / "roads.db")
    database = f"sqlite:///{tmp_path}/roads.db"
    done = run("backup", tmp_path / "copy.db", "--database", database)
    assert done.exit_code == 0, done.output
    assert "3 sessions" in done.output
    assert "version 3." in done.output
    done = run("restore", tmp_path / "copy.db", "--database", f"sqlite:///{tmp_path}/new.db")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("backup", "{}/x.db", "--database", "memory:"), "in the memory of a service"),
        (("backup", "{}/x.db", "--database", "mysql://x"), "names no kind of database"),
        (("backup", "{}/x.db", "--database", "sqlite:///{}/none.db"), "is not there"),
        (("backup", "{}/none/x.db"), "There is no folder"),
        (("restore", "{}/none.db"), "There is no file"),
        (("backup", "{}/x.db", "--url", "http://127.0.0.1:9"), "Is the service running?"),
    ],
)
def test_what_cannot_be_done_is_one_clear_line(arguments: tuple[str, ...], said: str, tmp_path: Path) -> None:
    done = run(*(each.replace("{}", str(tmp_path)) for each in arguments))
    assert done.exit_code == 1
    assert said in done.output
    assert not any(tmp_path.iterdir())
