"""What the README says is so: its script is run, its tables are compared, its files are there."""

from __future__ import annotations

import doctest
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import httpx
import pytest

from service.cli.main import COMMANDS
from service.settings import Settings
from sim.plan.conformance import check
from tests.support.service_process import PATIENCE_S, ServiceProcess

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


def readmes() -> list[Path]:
    """Every README of the project, and none of what was set up beside it."""
    folders = ("", "bench", "docs", "prompts", "service", "sim", "web")
    found = {path for folder in folders[1:] for path in (ROOT / folder).rglob("README.md")}
    return [ROOT / "README.md", *sorted(found)]


def named(path: Path) -> str:
    return str(path.relative_to(ROOT))


def headings(path: Path) -> set[str]:
    """As a link names them."""
    text = re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    found = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading).strip().lower().replace(" ", "-") for heading in found}


def pages() -> list[Path]:
    """Every README, the rules, the measurements and everything in docs."""
    more = (*(ROOT / "docs").rglob("*.md"), *(ROOT / "bench").glob("*.md"), ROOT / "sim" / "RULES.md")
    return sorted({*readmes(), *more})


@pytest.mark.parametrize("path", pages(), ids=named)
def test_every_link_leads_to_a_file_and_its_heading(path: Path) -> None:
    for link in re.findall(r"\]\(([^):]+)\)", path.read_text(encoding="utf-8")):
        file, _, heading = link.partition("#")
        target = (path.parent / file) if file else path
        assert target.is_file(), link
        assert not heading or heading in headings(target), link


def test_the_index_of_decisions_names_each_once_in_order() -> None:
    folder = ROOT / "docs" / "decisions"
    index = re.findall(
        r"^\| \[(\d{4})\]\((.*?)\) \| (.*) \| (\S+) \|$",
        (folder / "README.md").read_text("utf-8"),
        re.MULTILINE,
    )
    assert [file for _, file, _, _ in index] == sorted(path.name for path in folder.glob("[0-9]*.md"))
    assert [int(number) for number, _, _, _ in index] == list(range(1, len(index) + 1))
    for number, file, title, date in index:
        assert (folder / file).read_text("utf-8").startswith(f"# {number}. {title}\n\nDate: {date}\n"), file


def test_every_command_of_roadtalk_that_is_named_is_there() -> None:
    told = "\n".join(path.read_text(encoding="utf-8") for path in readmes())
    assert (
        {"play", "say", "serve", "watch"}
        <= set(re.findall(r"(?:`|^)roadtalk ([a-z-]+)", told, re.MULTILINE))
        <= COMMANDS.keys()
    )


def test_what_a_shell_is_to_say_is_understood(tmp_path: Path) -> None:
    service = ServiceProcess(tmp_path / "readme.db")
    service.start()
    try:
        made, said = re.findall(r"curl --json '(.*)' \$api(\S+)", block("sh", 3))
        http = httpx.Client(base_url=f"{service.url}/api/v1", timeout=PATIENCE_S)
        identity = http.post(made[1], json=json.loads(made[0])).raise_for_status().json()["id"]
        http.post(said[1].replace("<id>", identity), json=json.loads(said[0])).raise_for_status()
        http.close()
        for line in block("sh", 2).replace("--ticks 20", "--ticks 2").splitlines():
            asked = [sys.executable, "-m", "service", *shlex.split(line)[1:], "--url", service.url]
            done = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=True)
            assert done.stdout
    finally:
        service.kill()


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
