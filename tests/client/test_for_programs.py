"""The commands in a pipe: JSON on each line, sentences from the input, exit codes that tell."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner, Result

from service.cli.main import cli
from service.client import Client
from tests.support.service_process import ServiceProcess


def asked(process: ServiceProcess, *words: str, given: str | None = None) -> Result:
    return CliRunner().invoke(cli, [*words, "--url", process.url], input=given)


def test_what_is_said_is_answered_as_the_service_answers(process: ServiceProcess, client: Client) -> None:
    session = client.create(seed=1, paused=True)
    told = asked(process, "say", "add five potholes", "--json", "--session", session.id)
    assert told.exit_code == 0, told.output
    answer = json.loads(told.stdout)
    assert answer["actions"] == [{"do": "add", "kind": "pothole", "count": 5}]
    assert answer["sequence"] == session.info().sequence == 1


@pytest.mark.parametrize(
    ("said", "status", "more"),
    [("add five potholes and order pizza", 422, "unparsed"), ("slower", 409, "choices")],
)
def test_a_refusal_is_a_problem_on_the_same_line(
    process: ServiceProcess, client: Client, said: str, status: int, more: str
) -> None:
    session = client.create(seed=1, paused=True)
    told = asked(process, "say", said, "--json", "--session", session.id)
    problem = json.loads(told.stdout)
    assert (told.exit_code, problem["status"]) == (1, status)
    assert problem[more]
    assert session.info().sequence == 0


def test_nobody_there_is_no_json(process: ServiceProcess) -> None:
    told = CliRunner().invoke(cli, ["say", "pause", "--json", "--url", "http://127.0.0.1:1"])
    assert (told.exit_code, told.stdout) == (1, "")
    assert "roadtalk serve" in told.stderr
    del process


def test_lines_of_the_input_are_said_until_one_is_refused(process: ServiceProcess, client: Client) -> None:
    session = client.create(seed=1, paused=True)
    lines = "add five potholes\n\n  add two potholes\norder pizza\nadd one pothole\n"
    told = asked(process, "say", "-", "--session", session.id, given=lines)
    assert told.exit_code == 1
    assert [line.partition(";")[0].partition(" in ")[0] for line in told.stdout.splitlines()] == [
        "Added 5 potholes",
        "Added 2 potholes",
    ]
    assert "pizza" in told.stderr
    assert session.info().sequence == 2
    assert asked(process, "say", "-", "--session", session.id, given="").exit_code == 0


def test_what_may_mean_two_things_is_not_asked_about_in_a_pipe(
    process: ServiceProcess, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = client.create(seed=1, paused=True)
    monkeypatch.setattr("typer.prompt", lambda *_, **__: pytest.fail("asked"))
    told = asked(process, "say", "-", "--session", session.id, given="slower\npause\n")
    assert (told.exit_code, session.info().sequence) == (1, 0)


def test_sessions_as_lines(process: ServiceProcess, client: Client) -> None:
    made = [client.create(name=f"road\x1b{number}", seed=number, paused=True).id for number in range(3)]
    told = asked(process, "sessions", "--json", "--limit", "3")
    assert told.exit_code == 0
    assert "\x1b" not in told.stdout
    rows = [json.loads(line) for line in told.stdout.splitlines()]
    assert [row["id"] for row in rows] == made[::-1]
    assert rows[0]["name"] == "road\x1b2"


def test_what_is_watched_as_lines(process: ServiceProcess, client: Client) -> None:
    session = client.create(seed=3, paused=True)
    session.say("playback speed 10x")
    session.resume()
    told = asked(process, "watch", "--json", "--ticks", "2", "--session", session.id)
    session.delete()
    assert told.exit_code == 0, told.output
    messages = [json.loads(line) for line in told.stdout.splitlines()]
    assert messages[0]["type"] == "hello"
    assert [message["type"] for message in messages].count("tick") == 2
