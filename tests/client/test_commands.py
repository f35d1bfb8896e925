"""The commands on top of the client, as people run them: their lines, their exit codes, their faults."""

from __future__ import annotations

import json
import os
import signal
import socket
import sqlite3
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from typer.testing import CliRunner

from service.cli import doctor
from service.cli import say as talking
from service.cli.main import cli
from service.cli.sessions import table
from service.cli.terminal import plain
from service.cli.watch import lines
from service.client import Changed, Client, Gone, LogEvent, Message, Session, SessionSummary, Standing
from service.client.messages import Hello
from service.settings import Settings
from tests.support.command import COMMAND, ENVIRONMENT, ROOT, run
from tests.support.service_process import ServiceProcess

COMMANDS = (
    "serve",
    "say",
    "watch",
    "replay",
    "sessions",
    "doctor",
    "check-planner",
    "language-eval",
    "language-fuzz",
)


@pytest.fixture
def recording(client: Client, tmp_path: Path) -> Path:
    """The file of a session that was changed and run."""
    session = client.create(name="kept", seed=5, paused=True)
    session.say("add five potholes")
    session.step(20)
    return session.recording().save(tmp_path / "road.json")


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_an_example(name: str) -> None:
    told = CliRunner().invoke(cli, [name, "--help"])
    assert told.exit_code == 0
    assert f"Example: roadtalk {name}" in told.output


def test_an_ambiguous_sentence_lists_its_meanings(process: ServiceProcess, client: Client) -> None:
    session = client.create(seed=1, paused=True)
    said = CliRunner().invoke(cli, ["say", "slower", "--url", process.url, "--session", session.id])
    assert said.exit_code == 1
    assert said.stdout == ""
    assert "  1  slow the simulation down" in said.stderr.splitlines()
    assert session.info().sequence == 0


def test_in_a_terminal_one_meaning_is_chosen(
    process: ServiceProcess, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = client.create(seed=1, paused=True)

    class Terminal:
        @staticmethod
        def isatty() -> bool:
            return True

    monkeypatch.setattr(talking, "sys", type("System", (), {"stdin": Terminal}))
    arguments = ["say", "slower", "--url", process.url, "--session", session.id]
    said = CliRunner().invoke(cli, arguments, input="9\n1\n")
    assert said.exit_code == 0, said.output
    assert "  1  slow the simulation down" in said.stdout
    assert session.info().sequence == 1


@contextmanager
def watching(process: ServiceProcess, session: Session, *options: str) -> Iterator[subprocess.Popen[str]]:
    """`roadtalk watch` on a session."""
    watcher = subprocess.Popen(
        [*COMMAND, "watch", "--session", session.id, "--url", process.url, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=ENVIRONMENT,
    )
    try:
        yield watcher
    finally:
        watcher.kill()
        watcher.communicate()


def test_a_session_is_watched_for_some_ticks(process: ServiceProcess, client: Client) -> None:
    session = client.create(name="watched", seed=1, paused=True)
    with watching(process, session, "--ticks", "3") as watcher:
        assert watcher.stdout is not None
        assert watcher.stdout.readline() == "Watching watched: tick 0, paused\n"
        moves = [decision.move for decision in session.step(3).decisions]
        out, err = watcher.communicate(timeout=120)
    assert (watcher.returncode, err) == (0, "")
    told = [line.split() for line in out.splitlines() if "*" not in line and "Nothing happens" not in line]
    assert [line[:2] for line in told] == [[str(tick), move] for tick, move in enumerate(moves, 1)]


def test_watching_ends_cleanly_with_the_interrupt_key(process: ServiceProcess, client: Client) -> None:
    session = client.create(seed=1, paused=True)
    with watching(process, session) as watcher:
        assert watcher.stdout is not None
        assert watcher.stdout.readline().startswith("Watching ")
        assert watcher.stdout.readline().startswith("Nothing happens while it is paused")
        session.say("add five potholes")
        assert "add five potholes: Added 5 potholes" in watcher.stdout.readline()
        watcher.send_signal(signal.SIGINT)
        out, err = watcher.communicate(timeout=120)
    assert (watcher.returncode, out.strip(), err) == (0, "", "")


def test_the_lines_of_a_watcher() -> None:
    assert list(lines(Gone(type="gone"))) == ["The session was deleted."]
    assert list(lines(Message(type="later"))) == []
    assert not isinstance(Message(type="later"), Hello)
    state = type("State", (), {"tick": 9})()
    assert list(lines(Standing(type="state", missed=(3, 8), state=state, event="e-1"))) == [
        "     9  ! ticks 3 to 8 were missed"
    ]
    found = LogEvent(5, 9, "no_way", "There is no way through.", (), None)
    told = {
        "type": "changed",
        "sequence": 1,
        "changes": (),
        "state": state,
        "event": "e-1",
    }
    assert list(lines(Changed(**told, events=(found,), text=None, reply=found.text))) == [
        "     9  * There is no way through."
    ]
    said = Changed(**told, events=(), text="add a wall", reply="Added. There is no way through.")
    assert list(lines(said)) == ["     9  > add a wall: Added. There is no way through."]
    assert LogEvent(1, 2, "crash", "text", (), None).tick == 2


def test_what_others_said_cannot_drive_the_terminal() -> None:
    assert plain("a\x1b[2Jb\rc\x07\u202ed\nü") == "a�[2Jb�c��d\nü"


def test_sessions_in_a_table(process: ServiceProcess, client: Client) -> None:
    session = client.create(name="[red]narrow\x1b[0m", seed=77, paused=True)
    told = run("sessions", "--limit", "1", "--url", process.url)
    assert told.returncode == 0, told.stderr
    row = next(line for line in told.stdout.splitlines() if session.id in line)
    assert "[red]narrow" in row
    assert "\x1b" not in row
    assert row.split()[-3:] == ["yes", "0", "77"]
    fork = session.fork(name="other")
    told = run("sessions", "--limit", "2", "--url", process.url)
    row = next(line for line in told.stdout.splitlines() if fork.id in line)
    assert row.split()[-4:] == ["77", f"{session.id},", "tick", "0"]
    assert table(())[1] == []
    assert SessionSummary.__dataclass_params__.frozen  # type: ignore[attr-defined]


@pytest.mark.parametrize("command", [("sessions",), ("watch",), ("say", "pause")])
def test_nobody_there_is_one_clear_line(command: tuple[str, ...]) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{free.getsockname()[1]}"
        told = CliRunner().invoke(cli, [*command, "--url", url])
    assert told.exit_code == 1
    assert "roadtalk serve" in told.stderr
    assert len(told.stderr.splitlines()) == 1


@pytest.mark.parametrize("url", ["localhost", "ftp://x"])
def test_what_is_no_address_is_one_clear_line(url: str) -> None:
    told = CliRunner().invoke(cli, ["sessions", "--url", url])
    assert (told.exit_code, len(told.stderr.splitlines())) == (1, 1)
    assert "no address" in told.stderr


def test_a_recording_is_replayed_without_a_service(recording: Path) -> None:
    digest = json.loads(recording.read_text())["digest"]
    told = run("replay", str(recording))
    assert told.returncode == 0, told.stderr
    assert told.stdout.splitlines() == [
        f"recorded  {digest}  tick 20",
        f"replayed  {digest}  tick 20",
        "The digests are the same.",
    ]


def test_a_recording_is_replayed_by_a_service(
    process: ServiceProcess, client: Client, recording: Path
) -> None:
    before = len(client.list(limit=200))
    told = CliRunner().invoke(cli, ["replay", str(recording), "--url", process.url])
    assert told.exit_code == 0, told.output
    made = told.stdout.split()[-1]
    assert client.session(made).info().name == "kept"
    assert len(client.list(limit=200)) == before + 1


def test_a_recording_that_was_changed_is_told(recording: Path) -> None:
    values = json.loads(recording.read_text())
    values["entries"][0]["actions"][0]["count"] = 4
    recording.write_text(json.dumps(values))
    told = CliRunner().invoke(cli, ["replay", str(recording)])
    assert told.exit_code == 1
    assert values["entries"][0]["digest"] in told.stderr
    assert "Entry 1 ends in" in told.stderr
    assert "Traceback" not in told.stderr


@pytest.mark.parametrize("text", ["", "{", "[]", '{"digest": 3}', '{"digest": "d"}'])
def test_what_is_no_recording(text: str, tmp_path: Path) -> None:
    file = tmp_path / "no.json"
    file.write_text(text)
    told = CliRunner().invoke(cli, ["replay", str(file)])
    assert told.exit_code == 1
    assert len([line for line in told.stderr.splitlines() if not line.startswith("Loading")]) == 1
    assert CliRunner().invoke(cli, ["replay", str(tmp_path / "none.json")]).exit_code == 1


def test_the_doctor_finds_this_machine_fit(tmp_path: Path) -> None:
    environment = {"ROADTALK_DATABASE": f"sqlite:///{tmp_path}/roads.db", "ROADTALK_PORT": "0"}
    told = CliRunner().invoke(cli, ["doctor"], env=environment)
    assert told.exit_code == 0, told.output
    assert [line.split()[1] for line in told.stdout.splitlines() if not line.startswith(" ")] == [
        *doctor.CHECKS
    ]
    assert "fault" not in told.stdout
    assert list(tmp_path.iterdir()) == []


def test_the_doctor_says_what_to_do() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        environment = {
            "ROADTALK_DATABASE": "sqlite:////no/such/folder/roads.db",
            "ROADTALK_PORT": str(taken.getsockname()[1]),
        }
        told = CliRunner().invoke(cli, ["doctor"], env=environment)
    assert told.exit_code == 1
    assert told.stdout.count("fault") == 2
    assert "ROADTALK_DATABASE=" in told.stdout
    assert "--port" in told.stdout
    wrong = CliRunner().invoke(cli, ["doctor"], env={"ROADTALK_PORT": "many"})
    assert wrong.exit_code == 1
    assert "Correct ROADTALK_PORT." in wrong.stdout


def test_the_doctor_on_databases(process: ServiceProcess, tmp_path: Path) -> None:
    def found(path: Path) -> doctor.Finding:
        return doctor.database(Settings(database=f"sqlite:///{path}"))

    path = tmp_path / "roads.db"
    with sqlite3.connect(path) as connection:
        connection.execute("CREATE TABLE t (x)")
    connection.close()
    before = path.read_bytes()
    assert found(path).verdict == "ok"
    assert path.read_bytes() == before
    holding = sqlite3.connect(path, isolation_level=None)
    holding.execute("BEGIN EXCLUSIVE")
    assert "in use" in found(path).text
    holding.close()
    damaged = tmp_path / "damaged.db"
    damaged.write_bytes(os.urandom(8192))
    assert found(damaged).verdict == "fault"
    assert found(tmp_path).verdict == "fault"
    assert doctor.database(Settings(database="memory:")).verdict == "note"
    assert doctor.port(Settings(port=int(process.url.rsplit(":", 1)[1]))).text.count("this service") == 1
