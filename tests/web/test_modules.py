"""The page's modules, by their own unit tests under Node; the page itself needs no Node.

Where Node is not installed they are skipped and left to the browser tests; `make setup` installs it. ESLint
and TypeScript look at the modules in `make check`.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from service.http.page_texts import StaticTexts, page_texts
from service.narration.sayings import Sayings
from sim import planner_names
from sim.actions import Layout

HERE = Path(__file__).parent
ROOT = HERE.parents[1]


def test_the_modules_pass_their_unit_tests(tmp_path: Path) -> None:
    beside = Path(sys.executable).with_name("node")
    node = str(beside) if beside.exists() else shutil.which("node")
    if node is None:
        pytest.skip("Node is not installed (`make setup` installs it)")
    texts = tmp_path / "en.json"
    texts.write_bytes(StaticTexts("en").content())
    files = sorted(str(path) for path in HERE.glob("*.test.mjs"))
    run = subprocess.run(
        [node, "--import", str(HERE / "dom.mjs"), "--test", *files],
        cwd=ROOT,
        env={**os.environ, "NO_COLOR": "1", "PAGE_TEXTS": str(texts)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert len(files) >= 8
    assert run.returncode == 0, run.stdout[-6000:] + run.stderr[-2000:]


def test_planners_and_families_of_roads_are_named_as_the_service_names_them() -> None:
    """In the words of its answers and the order of the choice; a planner without words goes by its name."""
    source = (ROOT / "web" / "src" / "core" / "words.js").read_text(encoding="utf-8")
    sayings, texts = Sayings.load(), page_texts("en")

    def names(table: str) -> list[str]:
        found = re.search(rf"const {table} = \[(.*?)\];", source, re.DOTALL)
        assert found
        return re.findall(r'"(\w+)"', found[1])

    planners, layouts = names("PLANNERS"), names("LAYOUTS")
    assert planners == [name for name in planner_names.BUILT_IN if name in planners]
    assert set(planners) == set(sayings.words("words", "planners"))
    assert list(layouts) == list(get_args(Layout))
    for name in planners:
        assert texts[f"planners.{name}"] == sayings.say("words", "planners", name, "name")
    for name in layouts:
        assert texts[f"layouts.{name}"] == sayings.say("replies", "layouts", name)
