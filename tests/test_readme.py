"""What the README says is so: its script is run, its tables are compared, its files are there."""

from __future__ import annotations

import doctest
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from service.settings import Settings
from sim.plan.checker import check
from tests.browser.service_process import ServiceProcess

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str, number: int = 0) -> str:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)[number]


def test_the_script_prints_what_stands_below_it(tmp_path: Path) -> None:
    service = ServiceProcess(tmp_path / "readme.db")
    service.start()
    try:
        script = block("python").replace("http://127.0.0.1:8000", service.url)
        assert len(script.replace(",\n", ",").strip().splitlines()) == 7  # the import, and six lines
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    finally:
        service.kill()
    assert done.stdout == block("text")


def test_every_setting_is_in_the_table_as_it_is() -> None:
    rows = dict(re.findall(r"^\| `ROADTALK_(\w+)` \| (.*) \|$", README, re.MULTILINE))
    described = {
        name.upper(): f"`{field.default}` | {field.description}"
        for name, field in Settings.model_fields.items()
    }
    assert rows == described


def test_every_command_named_is_a_target_of_make() -> None:
    targets = set(re.findall(r"^(\w+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    named = set(re.findall(r"`?make (\w+)`?", README))
    assert {"run", "test", "setup", "check", "bench"} <= named <= targets


@pytest.mark.parametrize("link", re.findall(r"\]\(([^)#:]+)\)", README))
def test_every_link_leads_to_a_file(link: str) -> None:
    assert (ROOT / link).is_file()


def test_the_planner_shown_keeps_its_promises() -> None:
    text = (ROOT / "sim" / "plan" / "README.md").read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    exec(re.findall(r"```python\n(.*?)```", text, re.DOTALL)[0], names)
    report = check(names["Patient"]())
    assert report.decisions > 100
    assert report.defects == ()


@pytest.mark.parametrize("name", ["README.md", "sim/README.md"])
def test_the_examples_of_the_world_are_so(name: str) -> None:
    results = doctest.testfile(str(ROOT / name), module_relative=False)
    assert (results.failed, results.attempted > 3) == (0, True)
