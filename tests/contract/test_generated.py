"""A short run of `tools.generated_requests` on the real service: every call, every check, from one seed."""

from __future__ import annotations

import signal
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.contract.document import document
from tests.contract.running import Report, Tally, Tool, serving
from tests.contract.whole import Part, Whole
from tools import generated_requests as generated

pytest.importorskip("schemathesis")

DOCUMENT = document()
CALLS = {f"{method.upper()} {path}" for path, item in DOCUMENT["paths"].items() for method in item}


def test_a_refusal_that_is_expected_is_documented() -> None:
    for (method, path), (statuses, reasons) in generated.REFUSED.items():
        operation = DOCUMENT["paths"][path][method.lower()]
        assert {str(status) for status in statuses} <= set(operation["responses"]), (method, path)
        told = " ".join(reasons)
        assert all(f"{status}:" in told for status in statuses), (method, path)


def test_generated_requests_find_nothing_and_nobody_comes_in_without_the_key(tmp_path: Path) -> None:
    phases = ("examples", "fuzzing", "stateful")
    with serving(tmp_path, generated.SMALL, key=generated.KEY) as url:
        tool = Tool(url, tmp_path, generated.configuration(DOCUMENT), key=generated.KEY)
        report = tool.run(phases, seed=7, examples=1)
    assert report.clean, report.output
    assert report.complete
    assert report.cases > 100
    assert set(report.tally.calls) == CALLS
    assert report.tally.answers >= report.cases
    assert not any(status >= 500 for status in report.tally.statuses)
    assert {name for name, status in report.phases.items() if status == "success"} == set(phases)


# How a whole run goes about it: the tool is replaced.


class FakeTool(Tool):
    """Seven cases for each example; what is asked of it is kept."""

    def __init__(self, violated: str | None = None, stopped_in: str | None = None) -> None:
        super().__init__("", Path(), "")
        self.asked: list[tuple[str, int, int]] = []
        self.violated, self.stopped_in = violated, stopped_in

    def run(
        self,
        phases: Any,
        *,
        seed: int,
        examples: int,
        until: float = float("inf"),  # noqa: ARG002
        follow: Callable[[Tally], None] = lambda _: None,
    ) -> Report:
        (phase,) = phases
        self.asked.append((phase, seed, examples))
        stopped = phase == self.stopped_in
        found = Counter({"GET /healthz, 200: wrong": 2} if phase == self.violated else {})
        tally = Tally(Counter({"GET /healthz": 7 * examples}), Counter({200: 7 * examples}), found)
        follow(tally)
        return Report(tally, 7 * examples, (), (), 1, {}, 1.0, "what it said", complete=not stopped)


def test_a_phase_goes_on_from_other_seeds_until_it_has_made_its_cases() -> None:
    tool = FakeTool()
    run = Whole(tool, [Part("coverage", examples=1), Part("stateful", 2_000, examples=60)], seed=3)
    run.go()
    assert run.complete
    assert run.cases["coverage"] == 7
    assert run.cases["stateful"] >= 2_000
    assert [(phase, seed) for phase, seed, _ in tool.asked] == [
        ("coverage", 3),
        ("stateful", 3),
        ("stateful", 4),
    ]


def test_two_thirds_of_what_is_made_by_chance_are_stateful() -> None:
    wanted = {part.phase: part.cases for part in generated.plan(3_000)}
    assert wanted == {"examples": 0, "coverage": 0, "fuzzing": 1_000, "stateful": 2_000}


def test_a_run_that_is_stopped_tells_what_it_has(capsys: pytest.CaptureFixture[str]) -> None:
    run = Whole(FakeTool(violated="fuzzing", stopped_in="fuzzing"), generated.plan(300))
    run.go()
    run.tell(CALLS)
    told = capsys.readouterr().out
    assert not run.complete
    assert "stateful" not in run.cases
    assert "what it said" in told
    assert "violated 2 times: GET /healthz, 200: wrong" in told
    assert told.splitlines()[-1] == (
        "154 cases, 0 of them stateful, on 1 calls in 3 s, stopped before its end: "
        "0 server errors, 1 violations"
    )


def test_a_request_to_end_is_heeded_and_the_signal_given_back() -> None:
    def end(_: Tally) -> None:
        signal.raise_signal(signal.SIGTERM)

    class Ending(FakeTool):
        def run(self, *given: Any, **named: Any) -> Report:
            return super().run(*given, **{**named, "follow": end})

    before = signal.getsignal(signal.SIGTERM)
    run = Whole(Ending(), generated.plan(300))
    run.go()
    assert not run.complete
    assert signal.getsignal(signal.SIGTERM) is before
