"""`roadtalk play` as it is called: what it refuses, and in which words."""

from __future__ import annotations

import subprocess
import sys
from os import environ

import pytest

NOWHERE = {
    name: value
    for name, value in environ.items()
    if name not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")
}


def play(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "service.window", *arguments]
    return subprocess.run(command, env=NOWHERE, capture_output=True, text=True, timeout=300, check=False)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--potholes", "3"), "There is no display to open a window on"),
        (("--potholes", "900"), "there is room for 196"),
        (("--planner", "nobody"), "There is no planner called nobody. There are: rules, priority"),
        (("--size", "10x10"), "'10x10' is no size of a window"),
        (("--scenario", "the colour of money"), "I did not understand"),
        (("--scenario", "add two cars"), "does not describe a road"),
        (("--scenario", "a highway with 900 potholes"), "room for"),
    ],
)
def test_what_cannot_be_is_one_clear_sentence(arguments: tuple[str, ...], said: str) -> None:
    done = play(*arguments)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_it_is_a_command_of_roadtalk() -> None:
    from typer.testing import CliRunner

    from service.cli.main import cli

    shown = CliRunner().invoke(cli, ["play", "--help"], env={"COLUMNS": "200"})
    assert shown.exit_code == 0
    for option in ("--potholes", "--obstacles", "--seed", "--scenario", "--planner", "--size"):
        assert option in shown.stdout


def test_importing_the_command_imports_no_pygame() -> None:
    program = "import sys, service.window.command; print('pygame' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_an_option_stands_beside_a_scenario() -> None:
    from service.window.loading import load
    from service.window.scenario import scenario_in

    scenario = scenario_in("a highway with 10 potholes and 4 cars", load().languages)
    assert (scenario.road, scenario.potholes, scenario.vehicles) == ("highway", 10, 4)


def test_a_language_that_cannot_be_read_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    from service.window import loading

    def missing() -> loading.Loaded:
        raise FileNotFoundError("no words here")

    monkeypatch.setattr(loading, "load", missing)
    with pytest.raises(loading.LoadError, match="The language cannot be read: no words here"):
        loading.Loading().wait()
