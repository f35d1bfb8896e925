"""What the README and the documentation say is so: scripts run, links lead somewhere, commands exist."""

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
from sim.plan.conformance import check
from tests.support.service_process import PATIENCE_S, ServiceProcess

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
DOCS = ROOT / "docs"
FOLDERS = ("bench", "examples", "prompts", "service", "sim", "web")
LINK = re.compile(r"\]\(([^):]+)\)")


def block(language: str, number: int = 0, text: str = README) -> str:
    found: list[str] = re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)
    return found[number]


def page(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def pages() -> list[Path]:
    """Every text that is written by hand."""
    maps = (path for folder in FOLDERS for path in (ROOT / folder).rglob("README.md"))
    maps = (path for path in maps if "node_modules" not in path.parts)
    docs = (path for path in DOCS.rglob("*.md") if not path.is_relative_to(DOCS / "site"))
    return sorted(
        {ROOT / "README.md", ROOT / "CONTRIBUTING.md", *maps, *docs, *(ROOT / "bench").glob("*.md")}
    )


def relative(path: Path) -> str:
    return str(path.relative_to(ROOT))


def headings(path: Path) -> set[str]:
    """As a link names them."""
    text = re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    found = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading).strip().lower().replace(" ", "-") for heading in found}


def python(script: str, url: str) -> str:
    script = script.replace("http://127.0.0.1:8000", url)
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT
    )
    return done.stdout


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Any:
    service = ServiceProcess(tmp_path_factory.mktemp("readme") / "readme.db")
    service.start()
    yield service.url
    service.kill()


pytestmark = pytest.mark.xdist_group("readme")  # which share a service


def test_the_script_prints_what_stands_below_it(url: str) -> None:
    assert python(block("python"), url) == block("text")


def test_the_tutorial_prints_what_stands_below_it(url: str) -> None:
    text = page("tutorials/from-a-script.md")
    first, actions, refusals = (block("python", number, text) for number in range(3))
    printed, refused = (block("text", number, text) for number in range(2))
    assert python(first, url) == printed
    told = python(first + actions + refusals, url)
    assert told.startswith(printed)
    assert told.endswith(refused)


def test_what_a_shell_is_to_say_is_understood(url: str) -> None:
    made, said = re.findall(r"curl --json '(.*)' \$api(\S+)", block("sh", 3))
    with httpx.Client(base_url=f"{url}/api/v1", timeout=PATIENCE_S) as http:
        identity = http.post(made[1], json=json.loads(made[0])).raise_for_status().json()["id"]
        http.post(said[1].replace("<id>", identity), json=json.loads(said[0])).raise_for_status()
    lines = [
        line for line in block("sh", 2).replace("--ticks 20", "--ticks 2").splitlines() if "roadtalk" in line
    ]
    assert len(lines) == 2
    for line in lines:
        asked = [sys.executable, "-m", "service", *shlex.split(line)[1:], "--url", url]
        done = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=True)
        assert done.stdout


def test_what_the_guide_has_people_say_is_understood(url: str) -> None:
    """Sentences that a tutorial quotes, one after the other."""
    for name in ("first-minute.md", "teach-a-phrase.md"):
        sentences = re.findall(r"^> (.*)$", page(f"tutorials/{name}"), re.MULTILINE)
        assert len(sentences) >= 3
        with httpx.Client(base_url=f"{url}/api/v1", timeout=PATIENCE_S) as http:
            path = f"/sessions/{http.post('/sessions', json={'seed': 7, 'paused': True}).json()['id']}"
            http.post(f"{path}/step", json={"ticks": 3}).raise_for_status()
            for text in sentences:
                answer = http.post(f"{path}/commands", json={"text": text})
                assert answer.status_code == 200, answer.text


def test_every_command_named_is_a_target_of_make() -> None:
    targets = set(re.findall(r"^(\w+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    named = {
        name
        for path in pages()
        for name in re.findall(r"(?:`|^)make (\w+)", path.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert {"run", "test", "setup", "check", "bench", "docs"} <= named <= targets


def test_every_command_of_roadtalk_that_is_named_is_there() -> None:
    told = "\n".join(path.read_text(encoding="utf-8") for path in pages())
    named = set(re.findall(r"(?:`|^)roadtalk ([a-z-]+)", told, re.MULTILINE))
    assert {"play", "say", "serve", "watch", "replay", "doctor"} <= named <= COMMANDS.keys()


@pytest.mark.parametrize("path", pages(), ids=relative)
def test_every_link_leads_to_a_file_and_its_heading(path: Path) -> None:
    for link in LINK.findall(path.read_text(encoding="utf-8")):
        file, _, heading = link.partition("#")
        target = (path.parent / file) if file else path
        assert target.is_file(), link
        assert not heading or heading in headings(target), link


def test_the_index_of_decisions_names_each_once_in_order() -> None:
    folder = DOCS / "decisions"
    index = re.findall(
        r"^\| \[(\d{4})\]\((.*?)\) \| (.*) \| (\S+) \|$",
        (folder / "index.md").read_text("utf-8"),
        re.MULTILINE,
    )
    assert [file for _, file, _, _ in index] == sorted(path.name for path in folder.glob("[0-9]*.md"))
    assert [int(number) for number, _, _, _ in index] == list(range(1, len(index) + 1))
    for number, file, title, date in index:
        assert (folder / file).read_text("utf-8").startswith(f"# {number}. {title}\n\nDate: {date}\n"), file


def test_the_planner_of_the_tutorial_keeps_its_promises() -> None:
    names: dict[str, Any] = {}
    exec(block("python", 0, page("tutorials/own-planner.md")), names)
    report = check(names["Patient"]())
    assert report.decisions > 100
    assert report.defects == ()


@pytest.mark.parametrize(
    "name",
    [
        "README.md",
        "docs/how-to/simulate-many-worlds.md",
        "docs/how-to/train-with-gymnasium.md",
        "docs/reference/simulator.md",
    ],
)
def test_the_examples_are_so(name: str) -> None:
    results = doctest.testfile(str(ROOT / name), module_relative=False, encoding="utf-8")
    assert (results.failed, results.attempted > 3) == (0, True)
