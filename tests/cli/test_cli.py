"""The command as people run it: a process of its own, its lines, its exit codes, and a sudden end."""

from __future__ import annotations

import queue
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path

import httpx
import pytest
from typer.testing import CliRunner

from service.app import create_app
from service.cli.main import COMMANDS, cli, load_command
from service.cli.serve import warmed
from service.settings import Settings
from tests.support.command import COMMAND, ENVIRONMENT, ROOT, run


@contextmanager
def serving(database: Path, *, port: int = 0) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A running service and its address, as it printed it."""
    arguments = ["serve", "--port", str(port), "--database", f"sqlite:///{database}"]
    process = subprocess.Popen(
        [*COMMAND, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=ENVIRONMENT,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    lines: queue.Queue[str] = queue.Queue()
    reader = threading.Thread(target=lambda: [lines.put(line) for line in process.stdout or ()])
    reader.start()
    try:
        line = lines.get(timeout=300)
        found = re.fullmatch(r"Roadtalk is at (http://127\.0\.0\.1:\d+)\n", line)
        assert found, line
        yield process, found[1]
    finally:
        process.kill()
        process.wait(60)
        reader.join(30)
        process.stdout.close()
        process.stderr.close()


@pytest.fixture
def database(tmp_path: Path) -> Path:
    return tmp_path / "roads.db"


def test_it_says_who_it_is() -> None:
    assert re.match(r"roadtalk \S+\n", run("--version").stdout)
    told = CliRunner().invoke(cli, ["--help"]).stdout
    assert "serve" in told
    assert "say" in told


@pytest.mark.parametrize("name", COMMANDS)
def test_the_list_of_commands_says_what_each_says_of_itself(name: str) -> None:
    said = " ".join((load_command(name).help or "").partition("\n\n")[0].split())
    assert said.startswith(COMMANDS[name][1])
    assert COMMANDS[name][1].endswith(".")


def test_neither_the_version_nor_the_help_loads_the_service() -> None:
    code = (
        "import sys\n"
        "from typer.testing import CliRunner\n"
        "from service.cli.main import cli\n"
        "for option in ('--version', '--help'):\n"
        "    assert CliRunner().invoke(cli, [option]).exit_code == 0\n"
        "heavy = {'fastapi', 'sim', 'sqlalchemy', 'uvicorn', 'numpy', 'service.settings'}\n"
        "print(sorted(heavy & sys.modules.keys()))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=ENVIRONMENT, capture_output=True, text=True
    )
    assert done.stdout == "[]\n", done.stderr


def test_talking_from_a_terminal(database: Path) -> None:
    with serving(database) as (process, url):
        first = run("say", "add five potholes", "--url", url)
        assert first.returncode == 0, first.stderr
        assert "there are" in first.stdout
        sessions = httpx.get(f"{url}/api/v1/sessions", timeout=60).json()["items"]
        assert len(sessions) == 1

        again = run("say", "undo", "--url", url, "--session", sessions[0]["id"])
        assert again.returncode == 0, again.stderr
        assert len(httpx.get(f"{url}/api/v1/sessions", timeout=60).json()["items"]) == 1

        refused = run("say", "add five potholes and order pizza", "--url", url)
        assert (refused.returncode, refused.stdout) == (1, "")
        assert "pizza" in refused.stderr
        assert "You could say:" in refused.stderr

        unknown = run("say", "pause", "--url", url, "--session", "nobody")
        assert unknown.returncode == 1
        assert "No session" in unknown.stderr

        process.send_signal(signal.SIGINT)
        # 1: ended by the deadline of a stop, which a busy machine may pass.
        assert process.wait(60) in (0, 1, 130, -signal.SIGINT)


def test_nobody_there() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        said = run("say", "pause", "--url", f"http://127.0.0.1:{free.getsockname()[1]}")
    assert said.returncode == 1
    assert "roadtalk serve" in said.stderr
    assert "Traceback" not in said.stderr


def test_a_port_that_is_taken(database: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        said = run("serve", "--port", str(taken.getsockname()[1]), "--database", f"sqlite:///{database}")
    assert said.returncode == 1
    assert "--port" in said.stderr
    assert "Traceback" not in said.stderr


@pytest.mark.parametrize("database_url", ["sqlite:////no/such/folder/roads.db", "mongodb://x", "sqlite:////"])
def test_a_database_that_cannot_be_opened(database_url: str) -> None:
    said = run("serve", "--port", "0", "--database", database_url)
    assert said.returncode == 1
    assert said.stdout == ""
    assert "database" in said.stderr
    assert "Traceback" not in said.stderr


def test_a_second_service_on_the_same_file(database: Path) -> None:
    with serving(database):
        said = run("serve", "--port", "0", "--database", f"sqlite:///{database}")
    assert said.returncode == 1
    assert "locked" in said.stderr
    assert "Traceback" not in said.stderr


def test_a_graceful_stop_remembers_the_clock(database: Path) -> None:
    with serving(database) as (process, url), httpx.Client(base_url=url, timeout=60) as client:
        made = client.post("/api/v1/sessions", json={"seed": 1, "config": {"step_seconds": 0.02}})
        path = made.headers["location"]
        deadline_s = time.monotonic() + 120
        while client.get(f"{path}/state").json()["tick"] < 20:
            assert time.monotonic() < deadline_s
        process.send_signal(signal.SIGTERM)
        process.wait(60)
    with serving(database) as (_, url):
        again = httpx.get(f"{url}{path}", timeout=60).json()
        assert again["tick"] >= 20
        assert again["paused"]


def test_what_was_acknowledged_survives_a_kill(database: Path) -> None:
    """Killed in the midst of commands, three times: every one that was answered is there, in order."""
    path, acknowledged, digests = None, 0, {}
    for _ in range(3):
        with serving(database) as (process, url), httpx.Client(base_url=url, timeout=60) as client:
            if path is None:
                path = client.post("/api/v1/sessions", json={"seed": 3, "paused": True}).headers["location"]
            session = client.get(path).json()
            assert session["sequence"] in (acknowledged, acknowledged + 1)
            if session["sequence"] == acknowledged and acknowledged in digests:
                assert client.get(f"{path}/state").json()["digest"] == digests[acknowledged]

            acknowledged = session["sequence"]
            killer = threading.Timer(0.01, process.kill)
            try:
                for answers in count():
                    if answers == 15:
                        killer.start()
                    actions = [{"do": "add", "kind": "pothole", "count": 1}, {"do": "step", "ticks": 1}]
                    if acknowledged % 2:
                        actions = [{"do": "undo"}]
                    answer = client.post(f"{path}/actions", json={"actions": actions})
                    assert answer.status_code == 200, answer.text
                    acknowledged = answer.json()["sequence"]
                    digests[acknowledged] = client.get(f"{path}/state").json()["digest"]
            except httpx.TransportError:
                killer.join()
    assert acknowledged > 20


async def test_what_the_first_request_builds_is_built_before_anyone_asks() -> None:
    app = create_app(Settings(database="memory:"))
    assert await warmed(app) == 200
    families = app.state.context.metrics.registry.collect()
    refusals = next(each for each in families if each.name == "roadtalk_refusals")
    assert {each.value for each in refusals.samples} == {0}
