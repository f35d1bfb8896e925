"""Commands that run for minutes: what is refused first, clusters, and success maps."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from typer.testing import CliRunner

from service.cli.long_runs import with_address
from service.cli.main import cli
from service.evaluations.named import state_as_road
from sim.config import Config
from sim.evaluate import Evaluation
from sim.evaluate.run import evaluate
from sim.evaluate.success_map import cells_of
from sim.state import SimState


def run(*words: object) -> Any:
    return CliRunner().invoke(cli, [*map(str, words)])


@pytest.mark.parametrize(
    ("given", "found"),
    [
        (["text", "--ray"], ["text", "--ray", "local"]),
        (["--ray", "run 5 episodes"], ["--ray", "local", "run 5 episodes"]),
        (["text", "--ray", "--json"], ["text", "--ray", "local", "--json"]),
        (["--ray", "10.0.0.1:6379", "text"], ["--ray", "10.0.0.1:6379", "text"]),
        (["text", "--ray", "auto"], ["text", "--ray", "auto"]),
        (["text", "--ray=auto"], ["text", "--ray=auto"]),
    ],
)
def test_ray_goes_without_an_address(given: list[str], found: list[str]) -> None:
    assert with_address(given) == found


@pytest.mark.parametrize("command", [("evaluate", "run 5 episodes"), ("worst", "find the hardest scenario")])
def test_without_ray_it_says_which_extra_has_it(
    command: tuple[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    done = run(*command, "--ray")
    assert done.exit_code == 1
    assert 'Ray is not installed here; it is in the extra "cluster".' in done.output


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--map", "potholes"), "--map takes two of potholes"),
        (("--map", "potholes,potholes"), "--map takes two of"),
        (("--map", "potholes,vehicles", "--vary", "potholes=3"), "between 2 and 12"),
        (("--map", "potholes,vehicles", "--vary", "weather=fog,rain"), "Nothing was started"),
        (("--map", "potholes,vehicles", "--service"), "--map is for"),
        (("--ray", "--service"), "--ray is for"),
        (("--to", "report.pdf"), "A report is written as"),
        (("--to", "/nowhere/report.md"), "There is no folder"),
    ],
)
def test_what_cannot_be_run_is_said_first(words: tuple[str, ...], told: str) -> None:
    done = run("evaluate", "run 5 episodes with the rule planner", *words)
    assert done.exit_code == 1
    assert told in done.output


def test_a_report_that_cannot_be_written_is_said_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = run("evaluate", "run 5 episodes", "--to", tmp_path / "a.md", "--to", Path(tmp_path, "b.md"))
    assert done.exit_code == 0, done.output
    (tmp_path / "folder.md").mkdir()
    refused = run("evaluate", "run 5 episodes", "--to", tmp_path / "folder.md")
    assert (refused.exit_code, "cannot be written" in refused.output) == (1, True)
    monkeypatch.setattr("service.cli.long_runs.disk_usage", lambda _: SimpleNamespace(free=3_000_000))
    refused = run("evaluate", "run 1000000 episodes", "--to", tmp_path / "all.csv")
    assert refused.exit_code == 1
    assert "all.csv may take 84 MB" in refused.output
    assert not (tmp_path / "all.csv").exists()


def test_a_disk_that_is_full_at_the_end_is_said_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    done = run("evaluate", "run 5 episodes", "--to", tmp_path / "report.md")
    assert done.exit_code == 1
    assert "report.md cannot be written: No space left on device." in done.output.replace("\n", "")
    assert "arrived" in done.output


def test_a_scenario_is_named_on_the_command_line(tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    done = run("evaluate", "run scenario gap-in-the-wall 10 times with A*", "--processes", 1, "--to", report)
    assert done.exit_code == 0, done.output
    other = run("scenario", "run", "gap-in-the-wall", "--runs", 10, "--planner", "astar", "--json")
    assert json.loads(report.read_bytes()) == json.loads(other.stdout)
    unknown = run("evaluate", 'run the scenario "flat earth" 10 times')
    assert (unknown.exit_code, "rush-hour" in unknown.output) == (1, True)


def test_this_road_is_that_of_the_seed(tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    asked = "run this road 3 times and tell me how often it crashes"
    unsaid = run("evaluate", asked)
    assert (unsaid.exit_code, "--seed" in unsaid.output) == (1, True)
    done = run("evaluate", asked, "--seed", 7, "--processes", 1, "--to", report)
    assert done.exit_code == 0, done.output
    config = Config(seed=7)
    road = state_as_road(SimState.start(config))
    spec = Evaluation(planners=(config.planner,), episodes=3, config=config, seed=7, world=road)
    assert json.loads(report.read_bytes())["result"] == json.loads(json.dumps(evaluate(spec)))


def test_a_success_map_as_json_is_that_of_python(tmp_path: Path) -> None:
    report = tmp_path / "map.json"
    done = run(
        "evaluate", "run 3 episodes with the priority planner", "--map", "potholes,vehicles", "--vary",
        "potholes=0,40", "--vary", "vehicles=30,0", "--processes", 1, "--to", report,
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    found = json.loads(report.read_bytes())
    spec = Evaluation.from_json(found["spec"])
    levels = {"potholes": (0, 40), "vehicles": (0, 30)}
    assert spec.cases == cells_of(("potholes", "vehicles"), levels, spec.config)
    assert found["result"] == json.loads(json.dumps(evaluate(spec)))
    assert "Priority rules arrives" in done.output or "Nowhere on the map" in done.output
