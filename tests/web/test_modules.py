"""The page's modules, by their own unit tests under Node; the page itself needs no Node.

Where Node is not installed they are skipped and left to the browser tests; in CI it is installed.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import get_args

import pytest

from service.narration.sayings import Sayings
from sim import planner_names
from sim.actions import Layout
from tests.support.skips import leave_out

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
TYPE_CHECK = "--noEmit --checkJs --strict --target es2023 --module es2022 --moduleResolution bundler"


def test_the_modules_pass_their_unit_tests() -> None:
    node = shutil.which("node")
    if node is None:
        pytest.skip("Node is not installed (Debian: apt-get install nodejs)")
    files = sorted(str(path) for path in HERE.glob("*.test.mjs"))
    run = subprocess.run(
        [node, "--test", *files],
        cwd=ROOT,
        env={**os.environ, "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert len(files) >= 8
    assert run.returncode == 0, run.stdout[-6000:] + run.stderr[-2000:]


def test_every_module_is_small_type_checked_and_says_what_it_is_for() -> None:
    modules = list((ROOT / "web" / "src").rglob("*.js"))
    assert len(modules) > 30
    for path in modules:
        source = path.read_text(encoding="utf-8")
        assert source.startswith("// @ts-check\n/**"), f"{path}: not type-checked, or without its purpose"
        assert len(source.splitlines()) < 300, f"{path} is too long"


def test_the_modules_pass_the_type_checker() -> None:
    """TypeScript, where it is at hand: on the path, or what `npx` finds without fetching anything."""
    checker = _type_checker()
    if checker is None:
        leave_out("TypeScript is not at hand, and Debian has none as new as the modules")
    source = ROOT / "web" / "src"
    run = subprocess.run(
        [*checker, *TYPE_CHECK.split(), str(source / "main.js"), str(source / "early.js")],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stdout[-6000:]


def _type_checker() -> list[str] | None:
    tsc = shutil.which("tsc")
    if tsc is not None:
        return [tsc]
    npx = shutil.which("npx")
    if npx is None:
        return None
    found = subprocess.run(
        [npx, "--no-install", "tsc", "--version"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    return [npx, "--no-install", "tsc"] if found.stdout.startswith("Version ") else None


def test_planners_and_families_of_roads_are_named_as_the_service_names_them() -> None:
    """In the words of its answers and the order of the choice; a planner without words goes by its name."""
    source = (ROOT / "web" / "src" / "core" / "words.js").read_text(encoding="utf-8")
    sayings = Sayings.load()

    def table(name: str) -> dict[str, str]:
        found = re.search(rf"const {name} = .*?\{{\n(.*?)\n\}}", source, re.DOTALL)
        assert found
        return dict(re.findall(r'^  (\w+): "(.*)",$', found[1], re.MULTILINE))

    planners, layouts = table("PLANNERS"), table("LAYOUTS")
    assert list(planners) == [name for name in planner_names.BUILT_IN if name in planners]
    assert set(planners) == set(sayings.words("words", "planners"))
    assert planners == {name: sayings.say("words", "planners", name, "name") for name in planners}
    assert list(layouts) == list(get_args(Layout))
    assert layouts == {name: sayings.say("replies", "layouts", name) for name in layouts}
