"""`roadtalk worst`: cases are written as files, and a check fails for as long as the planner does."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from service.cli.main import cli
from service.scenarios.file import read_scenario
from sim.falsify import Case


def run(*words: object) -> Any:
    return CliRunner().invoke(cli, ["worst", *map(str, words)])


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The cases and reports of one search."""
    folder = tmp_path_factory.mktemp("worst")
    reports = [f"--to={folder / f'report{ending}'}" for ending in (".html", ".md", ".json", ".csv")]
    text = "search 40 worlds for the worst one for the priority planner"
    done = run(text, "--processes", 1, "--cases", folder / "cases", *reports)
    assert done.exit_code == 0, done.output
    assert "Priority rules failed in" in done.output
    return folder


def test_each_case_is_a_file_and_in_the_report(folder: Path) -> None:
    cases = [Case.from_json(json.loads(path.read_bytes())) for path in (folder / "cases").glob("*.json")]
    assert cases
    named = [read_scenario(path.read_text()) for path in (folder / "cases").glob("*.yaml")]
    assert {scenario.name for scenario in named} == {case.name for case in cases}
    assert {case.config.planner for case in cases} == {"priority"}
    report = json.loads((folder / "report.json").read_bytes())
    assert {each["case"]["name"] for each in report["result"]["cases"]} == {case.name for case in cases}
    rows = list(csv.DictReader((folder / "report.csv").read_text().splitlines()))
    assert len(rows) == report["spec"]["worlds"] == 40
    assert "#/r/" in (folder / "report.html").read_text()


def test_a_check_says_what_still_fails_and_what_does_not(folder: Path) -> None:
    failing = run("--check", folder / "cases")
    assert failing.exit_code == 1
    assert "fails as recorded: stuck" in failing.output
    again = run("--check", folder / "report.json")
    assert sorted(again.output.splitlines()) == sorted(failing.output.splitlines())
    arriving = run("--check", folder / "cases", "--planner", "rules")
    assert arriving.exit_code == 0, arriving.output
    assert "arrives, after" in arriving.output


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["add five potholes"], "asks for no evaluation"),
        (["--worlds", 0], "must be between 1 and 100000"),
        (["--planner", "best"], "planner must be one of"),
        (["find the hardest scenario for DWA"], "is not available yet"),
        (["--to", "report.pdf"], "A report is written as"),
        (["--to", "no-such-folder/report.html"], "There is no folder"),
        (["--check", "no-such-file.json"], "cannot be read"),
    ],
)
def test_what_cannot_be_done_is_said_before_it_begins(words: list[object], told: str) -> None:
    done = run(*words)
    assert done.exit_code == 1
    assert told in done.output


def test_a_file_that_is_no_case_is_refused(tmp_path: Path, folder: Path) -> None:
    path = next((folder / "cases").glob("*.json"))
    broken = tmp_path / "broken.json"
    for text in ("[]", "{}", "not JSON", path.read_text().replace("forward", "stay")):
        broken.write_text(text)
        done = run("--check", broken)
        assert done.exit_code == 1
        assert "is no case" in done.output or "does not arrive any more" in done.output


def test_evaluate_says_which_command_searches() -> None:
    done = CliRunner().invoke(cli, ["evaluate", "find the hardest scenario"])
    assert done.exit_code == 1
    assert "roadtalk worst" in done.output
