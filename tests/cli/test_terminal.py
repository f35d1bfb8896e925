"""What the terminal prints: plain tables in a pipe, local times, planners, completion, a line at once."""

from __future__ import annotations

import subprocess
import sys
import time

import pytest

from service.cli.main import SLOW
from service.cli.planners import described
from service.cli.tables import local_time, plain_table
from service.client.messages import Hello
from sim import planner_names
from tests.support.command import ENVIRONMENT, ROOT, run


def test_a_table_in_a_pipe_is_plain_and_as_narrow_as_its_cells() -> None:
    lines = plain_table(("name", "tick"), [("a road", "7"), ("b", "1200")], right=(1,))
    assert lines == ["name    tick", "a road     7", "b       1200"]


@pytest.mark.parametrize(("zone", "told"), [("UTC", "10:00 UTC"), ("Europe/Berlin", "11:00 CET")])
def test_times_are_local_and_name_their_zone(monkeypatch: pytest.MonkeyPatch, zone: str, told: str) -> None:
    monkeypatch.setenv("TZ", zone)
    time.tzset()
    try:
        assert local_time("2026-01-05T10:00:00+00:00") == f"2026-01-05 {told}"
    finally:
        monkeypatch.undo()
        time.tzset()


def test_planners_are_listed_with_a_line_each() -> None:
    done = run("planners")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert [line.split()[0] for line in lines] == ["name", *planner_names.BUILT_IN]
    assert all(about for _, _, about in described())
    assert "│" not in done.stdout


def test_what_takes_long_says_so_before_it_is_loaded() -> None:
    done = run("doctor")
    assert done.stderr.splitlines()[0] == SLOW["doctor"]
    assert "Looking" not in done.stdout


@pytest.mark.parametrize(("words", "offered"), [("roadtalk sa", "say"), ("roadtalk watch --ti", "--ticks")])
def test_the_shell_completes_commands_and_their_options(words: str, offered: str) -> None:
    program = (
        "import sys; sys.argv = ['roadtalk']\nfrom service.cli.main import cli\ncli(prog_name='roadtalk')\n"
    )
    environment = {
        **ENVIRONMENT,
        "_ROADTALK_COMPLETE": "complete_bash",
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split()) - 1),
    }
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, env=environment, capture_output=True, text=True
    )
    assert offered in done.stdout.split(), done.stderr


def test_watching_what_is_paused_says_how_it_goes_on() -> None:
    from service.cli.watch import lines

    hello = Hello.__new__(Hello)
    state = type("State", (), {"paused": True, "tick": 3})()
    session = type("Session", (), {"name": None, "id": "abc"})()
    for name, value in {"state": state, "session": session, "resumed": False}.items():
        object.__setattr__(hello, name, value)
    told = list(lines(hello))
    assert told[0] == "Watching abc: tick 3, paused"
    assert "roadtalk say resume --session abc" in told[1]
