"""The wheel carries what the service needs that is not imported by name."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
BUNDLED = "service/_bundled"
pytestmark = pytest.mark.xdist_group("wheel")  # which is built once


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as `pip install` would, without a network."""
    folder = tmp_path_factory.mktemp("wheel")
    building = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(building, cwd=ROOT, check=True, capture_output=True, timeout=300)
    (built,) = folder.glob("*.whl")
    return built


def kept(*folders: str) -> set[str]:
    """All files under these folders but what Python makes."""
    files = (path for folder in folders for path in (ROOT / folder).rglob("*") if path.is_file())
    return {str(path.relative_to(ROOT)) for path in files if "__pycache__" not in path.parts}


def test_it_carries_all_there_is(wheel: Path) -> None:
    inside = set(zipfile.ZipFile(wheel).namelist())
    needed = kept("sim", "service") | {f"{BUNDLED}/{name}" for name in kept("web", "prompts")}
    assert needed - inside == set()
    assert len([name for name in inside if name.startswith("service/store/migrations/versions/v")]) >= 4
    assert {f"{BUNDLED}/web/index.html", f"{BUNDLED}/prompts/README.md"} <= inside
    guide = ROOT / "docs" / "site" / "index.html"
    assert (f"{BUNDLED}/guide/index.html" in inside) == guide.is_file()


def test_it_carries_nothing_else(wheel: Path) -> None:
    tops = {name.partition("/")[0] for name in zipfile.ZipFile(wheel).namelist()}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"sim", "service"}


def test_it_runs_from_the_wheel_alone(wheel: Path, tmp_path: Path) -> None:
    """Unpacked elsewhere: its page, its words, and a database with tables."""
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(tmp_path / "site")
    program = (
        "import asyncio, sys\n"
        "sys.path.insert(0, sys.argv[1])\n"
        "import service\n"
        "from service.resources import prompts_folder, web_folder\n"
        "from service.store import SqlStore\n"
        "from service.interpreter.languages import Languages\n"
        "assert service.__file__.startswith(sys.argv[1])\n"
        "assert (web_folder() / 'index.html').is_file()\n"
        "print(len(Languages.load().codes) > 0, str(prompts_folder()).startswith(sys.argv[1]))\n"
        "store = SqlStore('sqlite:///roads.db')\n"
        "async def tables():\n"
        "    await store.open()\n"
        "    print(await store.count())\n"
        "    await store.close()\n"
        "asyncio.run(tables())\n"
    )
    run = [sys.executable, "-c", program, str(tmp_path / "site")]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stdout) == (0, "True True\n0\n"), done.stderr


def test_environments_are_made_from_the_wheel_alone(wheel: Path, tmp_path: Path) -> None:
    """By name, in a program that imports nothing of it: Gymnasium imports the module before the colon."""
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(tmp_path / "site")
    program = (
        "import sys, warnings\n"
        "sys.path.insert(0, sys.argv[1])\n"
        "warnings.simplefilter('error')\n"
        "import gymnasium\n"
        "one = gymnasium.make('sim.env:Roadtalk-v0', config={'rows': 12})\n"
        "many = gymnasium.make_vec('sim.env:Roadtalk-v0', num_envs=3, config={'rows': 12})\n"
        "print(one.reset(seed=1)[0].shape, type(many).__name__, many.reset(seed=1)[0].shape)\n"
        "import sim\n"
        "assert sim.__file__.startswith(sys.argv[1])\n"
    )
    run = [sys.executable, "-c", program, str(tmp_path / "site")]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    shown = "(7, 12, 8) RoadVectorEnv (3, 7, 12, 8)\n"
    assert (done.returncode, done.stdout) == (0, shown), done.stderr
