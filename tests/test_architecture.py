"""The direction of dependence, checked on the source: no cycles, and nothing reaches up or out."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("sim", "service")
FOREIGN_TO_SIM = {"web", "service", "pydantic", "pydantic_core", "fastapi", "starlette", "yaml", "sqlalchemy"}
ONLY_IN_VIEW = {"pygame"}


def modules() -> dict[str, Path]:
    """Every module of the project by its dotted name."""
    found = {}
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


MODULES = modules()


def imports(path: Path, *, whole: bool) -> Iterator[str]:
    """Dotted names that a module imports: when it is loaded, or anywhere at all (`whole`)."""
    for node in nodes(ast.parse(path.read_text()), whole=whole):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports relatively"
            assert node.module is not None
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def nodes(tree: ast.AST, *, whole: bool) -> Iterator[ast.AST]:
    """The nodes of a module; without function bodies and what only a type checker reads unless `whole`."""
    for child in ast.iter_child_nodes(tree):
        if not whole and (
            isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
            or (isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test))
        ):
            continue
        yield child
        yield from nodes(child, whole=whole)


def loaded_by(name: str) -> set[str]:
    """The project's modules that a module needs when it is loaded, other than itself and its parents.

    Loading a module loads the packages that it is in first.
    """
    named = {other for other in imports(MODULES[name], whole=False) if other in MODULES}
    needed = {other for each in named for other in (each, *packages_of(each))}
    return {
        other for other in needed & set(MODULES) if other != name and not f"{name}.".startswith(f"{other}.")
    }


def packages_of(name: str) -> list[str]:
    """The packages that a module is in."""
    parts = name.split(".")
    return [".".join(parts[:end]) for end in range(1, len(parts))]


def test_there_is_something_to_check() -> None:
    assert {"sim.state", "sim.rules.traffic", "sim.session.timeline", "sim.plan.priority"} <= set(MODULES)
    assert {"sim.commit", "sim.decide", "sim.state"} <= loaded_by("sim.transition")


def test_no_import_cycles() -> None:
    graph = {name: loaded_by(name) for name in MODULES}
    finished: set[str] = set()

    def visit(name: str, way: tuple[str, ...]) -> None:
        if name in finished:
            return
        assert name not in way, " → ".join((*way[way.index(name) :], name))
        for other in sorted(graph[name]):
            visit(other, (*way, name))
        finished.add(name)

    for name in graph:
        visit(name, ())


@pytest.mark.parametrize("name", [name for name in MODULES if name.split(".")[0] == "sim"])
def test_sim_reaches_neither_up_nor_out(name: str) -> None:
    tops = {imported.split(".")[0] for imported in imports(MODULES[name], whole=True)}
    assert tops.isdisjoint(FOREIGN_TO_SIM)
    if not name.startswith("sim.render"):
        assert tops.isdisjoint(ONLY_IN_VIEW)
        # A learning environment can be looked at: it is an edge of `sim`, nothing else there imports it.
        assert "sim.render" not in set(imports(MODULES[name], whole=True)) or name == "sim.env.single"


@pytest.mark.parametrize(
    "name",
    ["sim.judge", "sim.validation", "sim.commit", "sim.world", "sim.rules.traffic", "sim.world.notation"],
)
def test_the_world_and_its_judge_know_no_planner_and_no_forecast(name: str) -> None:
    way, seen = [name], {name}
    while way:
        for other in loaded_by(way.pop()) - seen:
            seen.add(other)
            way.append(other)
    unknown = ("sim.plan.", "sim.forecast.", "sim.perceive.")
    assert not {other for other in seen if f"{other}.".startswith(unknown)}


def test_planners_read_the_forecast_and_never_the_world() -> None:
    for name in MODULES:
        if name.startswith("sim.plan"):
            assert "sim.world" not in set(imports(MODULES[name], whole=True)), name


def test_a_live_session_needs_nothing_heavy() -> None:
    program = (
        "import sys, sim.state, sim.session.timeline\n"
        "heavy = {'numba', 'numpy', 'pygame', 'pydantic', 'fastapi', 'yaml', 'sqlalchemy', 'service'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "[]"


def test_only_the_protocol_package_reads_what_uvicorn_does_not_document() -> None:
    undocumented = ("uvicorn.protocols", "uvicorn.server", "websockets.protocol", "websockets.frames")
    for name in MODULES:
        if not f"{name}.".startswith("service.http.protocol."):
            reached = {each for each in imports(MODULES[name], whole=True) if each.startswith(undocumented)}
            assert not reached, name


def test_one_module_imports_numba_as_two_threads_would_block_each_other() -> None:
    names = {
        name
        for name in MODULES
        if any(f"{each}.".startswith("numba.") for each in imports(MODULES[name], whole=True))
    }
    assert names == {"sim.compilation"}
