"""The examples run: programs in a process of their own, notebooks in a kernel."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from service.client.notebook import WIDGET_VIEW
from tests.support.service_process import ROOT, ServiceProcess

EXAMPLES = ROOT / "examples"
WITH_SERVICE = {"first_steps.py", "watch_live.py", "notebook_client.ipynb"}
LIMIT_S = 300
pytestmark = pytest.mark.xdist_group("examples")  # which share a service


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServiceProcess]:
    process = ServiceProcess(tmp_path_factory.mktemp("examples") / "examples.db")
    process.start()
    yield process
    process.kill()


def run(name: str, *arguments: str) -> str:
    """What an example prints."""
    command = [sys.executable, "-W", "error", str(EXAMPLES / name), *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=LIMIT_S)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_first_steps(service: ServiceProcess) -> None:
    lines = run("first_steps.py", service.url).splitlines()
    assert lines[0] == "Added 5 potholes; there are 9 potholes now."
    assert 'I did not understand "order pizza". Nothing was changed.' in lines
    assert any(line.startswith("Choices: ") for line in lines)
    assert lines[-1].startswith("Tick 3, 7 potholes, 30 cars")


def test_a_session_is_watched(service: ServiceProcess) -> None:
    lines = run("watch_live.py", service.url).splitlines()
    ticks = [line for line in lines if line.startswith("Tick ")]
    assert len(ticks) == 5
    assert any(line.startswith("Changed: Added 5 potholes") for line in lines)


def test_planners_are_compared() -> None:
    heading, _, *rows = run("compare_planners.py", "3", "walls").splitlines()
    assert heading.startswith("3 roads, layout walls")
    assert [row.split()[0] for row in rows] == ["rules", "priority", "astar", "bfs"]


def test_the_own_planner_keeps_its_promises() -> None:
    checked, arrived = run("own_planner.py").splitlines()
    assert checked.endswith(" 0 defects")
    assert int(arrived.split()[2]) > 0


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_run(path: Path, service: ServiceProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROADTALK_URL", service.url)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=LIMIT_S, resources={"metadata": {"path": str(ROOT)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert shown
    assert all(output.output_type != "error" for output in shown)
    if path.stem == "notebook_client":
        forms = shown[0].data
        assert forms[WIDGET_VIEW]["model_id"]
        assert "<svg" in forms["text/html"], "where widgets are not shown, the road is"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_are_stored_without_outputs(path: Path) -> None:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert all(not cell.get("outputs") and cell.get("execution_count") is None for cell in cells)


def test_every_example_is_listed() -> None:
    listed = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    for path in (*EXAMPLES.glob("*.py"), *EXAMPLES.glob("*.ipynb")):
        (row,) = [line for line in listed.splitlines() if f"]({path.name})" in line]
        assert row.endswith("| yes: `make run` |") == (path.name in WITH_SERVICE)
