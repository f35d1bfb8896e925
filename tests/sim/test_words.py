"""Sentences for people stand in `prompts`: the simulator has codes and facts."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.literals import sentences

SIM = Path(__file__).parents[2] / "sim"
ELSEWHERE = {
    "env/actions.py": "parts of errors for who writes code",
    "env/observation.py": "parts of errors for who writes code",
    "env/options.py": "parts of errors for who writes code",
    "env/saved_state.py": "parts of errors for who writes code",
    "evaluate/metamorphic.py": "a tool for who writes planners",
    "evaluate/ray_executor.py": "what is wrong with a cluster, told on the command line",
    "falsify/case.py": "files that hold no case, told on the command line",
    "fast_replace.py": "source code that is made",
    "hazard_advice/parameters.py": "what each figure is and where it is from",
    "plan/conformance.py": "a tool for who writes planners",
    "plan/safe_planning.py": "what a planner of another package did",
    "plan/sandbox/answer.py": "what a planner of another package did",
    "plan/sandbox/client.py": "what a planner of another package did",
    "plan/sandbox/planner_process.py": "what a planner of another package did, and the program's log",
    "plan/sandbox/worker.py": "what a planner of another package did",
    "planner_names.py": "why the planner of a package is not used, for who wrote it",
    "render/log_view.py": "drawn in a picture",
    "render/hud.py": "drawn in a picture",
    "render/plan_view.py": "drawn in a picture",
    "render/video.py": "an error for who installs it",
    "search/compiled_costs.py": "a type",
    "world/notation.py": "patterns of the notation",
}
"""Where literals of that length stand, and what they are."""


MODULES = sorted(path.relative_to(SIM).as_posix() for path in SIM.rglob("*.py"))


@pytest.mark.parametrize("module", [module for module in MODULES if module not in ELSEWHERE])
def test_no_sentence_stands_in_the_simulator(module: str) -> None:
    assert list(sentences((SIM / module).read_text())) == []


@pytest.mark.parametrize("module", ELSEWHERE)
def test_the_exceptions_are_still_there(module: str) -> None:
    assert list(sentences((SIM / module).read_text()))


def test_what_is_taken_for_a_sentence() -> None:
    def found(source: str) -> list[str]:
        return [text for _, text in sentences(source)]

    assert found('"""A module of many words."""\nX = "tick"\nY = "a few words"') == []
    assert found('raise ValueError(f"{x} is not a lane of it")') == []
    assert found('raise EditError(f"There is no lane {lane} here.", "where")') == [
        "There is no lane x here.",
    ]
    assert found('X = "Not so."') == ["Not so."]
    assert found('def f(x):\n    return f"{x} of the {x}"') == ["x of the x"]
