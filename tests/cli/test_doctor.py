"""What `doctor` says of what is missing around the service, each thing taken away for real where it can."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from pathlib import Path

import pygame
import pytest

from service.cli import doctor, doctor_checks
from service.settings import Settings
from tests.support.postgres import Server

ROOT = Path(__file__).parents[2]
MODEL = {"llm_base_url": "http://127.0.0.1:1/v1", "llm_model": "small"}


def without(module: str, url: str = "memory:") -> subprocess.CompletedProcess[str]:
    """The doctor where one module cannot be imported."""
    program = (
        "import importlib.util, sys\n"
        "class Gone:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        f"        if name.partition('.')[0] == {module!r}:\n"
        "            raise ModuleNotFoundError(f'No module named {name!r}', name=name)\n"
        "sys.meta_path.insert(0, Gone())\n"
        "found = importlib.util.find_spec\n"
        f"importlib.util.find_spec = lambda name, *more: None if name == {module!r} else found(name, *more)\n"
        "from service.cli.main import main\n"
        "sys.argv = ['roadtalk', 'doctor']\n"
        "main()\n"
    )
    named = {f"ROADTALK_{name.upper()}": value for name, value in MODEL.items()}
    environment = os.environ | named | {"ROADTALK_DATABASE": url, "ROADTALK_PORT": "0", "COLUMNS": "200"}
    return subprocess.run(
        [sys.executable, "-c", program],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )


def test_a_model_without_its_extra_is_a_fault() -> None:
    done = without("pydantic_ai")
    assert done.returncode == 1, done.stderr
    assert "the extra 'llm' is not installed" in done.stdout
    assert "pip install 'roadtalk[llm]'" in done.stdout


def test_a_server_without_its_driver_is_a_fault() -> None:
    done = without("asyncpg", "postgresql://me:hunter2@127.0.0.1:1/roads")
    assert done.returncode == 1, done.stderr
    assert "pip install 'roadtalk[postgres]'" in done.stdout
    assert "hunter2" not in done.stdout


def test_a_model_is_named_in_full_or_not_at_all() -> None:
    assert doctor_checks.model(Settings()).verdict == "ok"
    for name in MODEL:
        found = doctor_checks.model(Settings(**{name: MODEL[name]}))  # type: ignore[arg-type]
        (other,) = MODEL.keys() - {name}
        assert (found.verdict, found.advice) == ("fault", f"Set ROADTALK_{other.upper()}.")
    assert doctor_checks.model(Settings(**MODEL)).text.startswith("small will be asked")  # type: ignore[arg-type]


def test_a_server_that_answers_and_one_that_does_not(postgres: Server) -> None:
    assert doctor.database(Settings(database=postgres.url("postgres"))).verdict == "ok"
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        url = f"postgresql://me:hunter2@127.0.0.1:{free.getsockname()[1]}/roads"
        found = doctor.database(Settings(database=url))
    assert found.verdict == "fault"
    assert "does not answer" in found.text
    assert "hunter2" not in found.text
    assert doctor.database(Settings(database="mongodb://me:hunter2@here")).verdict == "fault"


def test_a_folder_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "roads.db"
    assert doctor.database(Settings(database=f"sqlite:///{path}")).verdict == "ok"
    assert doctor.database(Settings(database="sqlite:////proc/roads.db")).verdict == "fault"
    # Whoever runs the tests as root may write everywhere.
    monkeypatch.setattr(os, "access", lambda at, _: Path(at) != tmp_path)
    found = doctor.database(Settings(database=f"sqlite:///{path}"))
    assert found.verdict == "fault"
    assert f"its folder {tmp_path} is read-only" in found.text
    assert found.advice.startswith("Choose another file")


def test_a_font_that_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    assert doctor_checks.pictures(Settings()).verdict == "ok"
    monkeypatch.setattr(pygame.font, "get_default_font", lambda: "gone.ttf")

    def gone(*_: object) -> None:
        raise FileNotFoundError("No file 'freesansbold.ttf' found")

    monkeypatch.setattr(pygame.font, "Font", gone)
    found = doctor_checks.pictures(Settings())
    assert found.verdict == "fault"
    assert "freesansbold.ttf" in found.text


@pytest.mark.parametrize(
    ("environment", "verdict"),
    [({"SDL_VIDEODRIVER": "dummy"}, "ok"), ({}, "note"), ({"SDL_VIDEODRIVER": "nonesuch"}, "note")],
)
def test_a_display(environment: dict[str, str], verdict: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    found = doctor_checks.window(Settings())
    assert found.verdict == verdict, found.text
    assert ("roadtalk play" in found.advice) is (verdict == "note")
