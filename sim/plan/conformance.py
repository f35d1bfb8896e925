"""Conformance check of a planner: tries every promise of a planner on many roads and lists all defects.

Checked: answers are legal decisions, in time; verdicts on moves agree with the forecast, and the name is the
planner's own; it does not drive into known things while another move is free; the same question has the same
answer, at once, after other questions and in another process; it changes nothing it is given; it reads no
further than its horizon. It receives a forecast of a percept and never a world.

A planner of another package runs in its own process, as in a session (`worker`). The comparison runs here,
where the planner cannot interfere.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from math import inf
from typing import Any, Final

from sim.config import Config
from sim.decide import sense
from sim.forecast import predict
from sim.perceive import Percept
from sim.plan.protocol import Planner
from sim.plan.registry import planner_named
from sim.plan.sandbox.answer import (
    FAULTS,
    Answer,
    CodedError,
    FaultError,
    answer_of,
    decision_of,
    fault_of,
    load_json,
    quote,
)
from sim.plan.sandbox.codec import parse_question, question
from sim.planner_names import installed, refused
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

MAX_TOLD = 20
GIVE_UP: Final = 3
"""The check stops after this many questions in a row without an answer."""
ASKED_ANEW: Final = 5
"""Number of questions that are repeated in another process."""

_LEGAL = frozenset(
    ("no-decision", "no-move", "elsewhere", "off-road", "no-verdicts", "no-number", "not-finite", "too-large")
)
_GRAVE = frozenset(
    ("died", "closed", "too-long", "out-of-turn", "no-json", "more", "unstartable", "unloadable")
)

Witness = tuple[Answer, dict[str, Any]]
"""An answer, and what the decision claims besides it."""
Ask = Callable[[Percept, Config], Witness]
"""Asks a planner. Raises `FaultError`, and `TimeoutError` if there is no answer in time."""
Tell = Callable[[str], None]
"""Receives progress messages."""


@dataclass(frozen=True, slots=True)
class Defect:
    """A broken promise, and where it was broken."""

    promise: str
    """`legal`, `honest`, `itself`, `careful`, `deterministic`, `harmless`, `bounded`, `prompt`, `answers`"""
    seed: int
    tick: int
    what: str


@dataclass(frozen=True, slots=True)
class Report:
    """The result of a check."""

    planner: str
    decisions: int
    defects: tuple[Defect, ...]
    untried: str | None = None
    """why nothing, or not everything, was checked"""


def moments(roads: int = 20, ticks: int = 12) -> Iterator[SimState]:
    """Yields states on roads of several sizes and densities, driven by the default planner."""
    for seed in range(roads):
        columns, rows = ((8, 30), (3, 12), (12, 20), (5, 8))[seed % 4]
        config = Config(
            columns=columns,
            rows=rows,
            seed=seed,
            potholes=(0, 3, columns * rows // 6, 8)[seed // 4 % 4],
            pedestrians=seed % 3,
            courtesy=0.5 if seed % 5 == 4 else 0.0,
        )
        state = SimState.start(config)
        for _ in range(ticks):
            if state.world.outcome is not Outcome.RUNNING:
                break
            yield state
            state = step(state).state


def check(planner: Planner, runs: Iterable[SimState] | None = None, tell: Tell | None = None) -> Report:
    """Checks a planner in this process; use `check_apart` for one that may hang."""
    trial = _Trial(planner.name, _ask_in_process(planner), tell=tell)
    trial.run(moments() if runs is None else runs)
    return trial.report()


def check_apart(
    name: str, seconds: float = 60.0, runs: Iterable[SimState] | None = None, tell: Tell | None = None
) -> Report:
    """Checks the installed planner of that name in a process of its own, for at most `seconds`.

    Always ends and returns a report, whatever the planner does.
    """
    from sim.plan.sandbox.planner_process import NoAnswerError
    from sim.plan.sandbox.worker import Worker

    until = time.monotonic() + seconds
    worker = Worker(name, installed()[name].value, memory=None)

    def ask(percept: Percept, config: Config) -> Witness:
        try:
            return worker.ask_in_full(percept, config).result(max(0.0, until - time.monotonic()))
        except NoAnswerError as silence:
            raise TimeoutError(str(silence)) from silence

    trial = _Trial(name, ask, until, tell)
    try:
        if trial.run(moments() if runs is None else runs):
            worker.stop()
            trial.ask_new_process()
    finally:
        worker.stop()
    return trial.report()


def find_planner(name: str) -> Planner | None:
    """Finds a planner of this program by name; None for planners of other packages."""
    return planner_named(name)


def name_conflicts(name: str) -> list[Defect]:
    """Lists defects of the name: other packages that claim it, or a reserved or invalid name."""
    return [
        Defect("itself", 0, 0, f"{where} asks for the name {other}, and is not used: {why}")
        for other, where, why in refused()
        if other == name
    ]


@dataclass
class _Trial:
    """The check of one planner, in progress."""

    name: str
    ask: Ask
    until: float = inf
    tell: Tell | None = None
    defects: list[Defect] = field(default_factory=list)
    answers: list[tuple[Percept, Config, Witness]] = field(default_factory=list)
    decisions: int = 0
    unanswered: int = 0
    untried: str | None = None

    def run(self, runs: Iterable[SimState]) -> bool:
        """Checks all states, then repeats all questions; returns whether it was completed."""
        for state in runs:
            if self._is_over():
                return False
            self._report_progress(f"road {state.config.seed + 1}, tick {state.world.tick}")
            self._check_moment(sense(state)[0], state.config)
        for number, (percept, config, before) in enumerate(reversed(self.answers), start=1):
            if self._is_over():
                return False
            self._report_progress(f"asking again, {number} of {len(self.answers)}")
            self._ask_again(percept, config, before, "after others")
        return True

    def ask_new_process(self) -> None:
        """Repeats some questions in another process."""
        for percept, config, before in self.answers[:ASKED_ANEW]:
            if self._is_over():
                return
            self._report_progress("asking another process")
            self._ask_again(percept, config, before, "by another process")

    def report(self) -> Report:
        """Returns the report."""
        return Report(self.name, self.decisions, tuple(self.defects), self.untried)

    def _is_over(self) -> bool:
        if self.untried is None and time.monotonic() >= self.until:
            self.untried = "the time is over"
        if self.untried is None and self.unanswered >= GIVE_UP:
            self.untried = f"it gave no answer {GIVE_UP} times in a row"
        return self.untried is not None

    def _report_progress(self, doing: str) -> None:
        if self.tell is not None:
            self.tell(f"{doing}: {self.decisions} decisions, {len(self.defects)} defects")

    def _check_moment(self, percept: Percept, config: Config) -> None:
        self.decisions += 1
        witness = self._ask(percept, config)
        if witness is None:
            return
        answer, claims = witness
        try:
            decision = decision_of(answer, percept, config)
        except FaultError as fault:
            self._add_defect("legal", percept, config, str(fault))
            return
        for promise, what in _false_claims(self.name, claims, percept):
            self._add_defect(promise, percept, config, what)
        if decision.chosen.reason.blocks and any(not option.reason.blocks for option in decision.options):
            what = f"{answer.move} is known to be blocked while another move is free"
            self._add_defect("careful", percept, config, what)
        if claims.get("changed") is not False:
            self._add_defect("harmless", percept, config, "what it was given was changed")
        self._ask_again(percept, config, witness, "at once")
        self.answers.append((percept, config, witness))

    def _ask_again(self, percept: Percept, config: Config, before: Witness, when: str) -> None:
        witness = self._ask(percept, config)
        if witness is not None and witness != before:
            what = f"the same question was answered differently {when}"
            self._add_defect("deterministic", percept, config, what)

    def _ask(self, percept: Percept, config: Config) -> Witness | None:
        try:
            witness = self.ask(percept, config)
        except TimeoutError as late:
            if time.monotonic() < self.until:
                self.unanswered += 1
                self._add_defect("prompt", percept, config, str(late))
            return None
        except FaultError as fault:
            code = fault.code if isinstance(fault, CodedError) else ""
            self.unanswered = self.unanswered + 1 if code in _GRAVE else 0
            promise = "bounded" if code == "too-far" else "legal" if code in _LEGAL else "answers"
            self._add_defect(
                promise, percept, config, f"{fault}: {fault.detail}" if fault.detail else str(fault)
            )
            if code == "unloadable":
                self.untried = "it could not be loaded"
            return None
        self.unanswered = 0
        return witness

    def _add_defect(self, promise: str, percept: Percept, config: Config, what: str) -> None:
        self.defects.append(Defect(promise, config.seed, percept.tick, what))


def _ask_in_process(planner: Planner) -> Ask:
    """Returns a function that asks a planner in this process, through the same codec."""
    from sim.plan.sandbox.worker_main import answer_with_claims, run_or_fault

    def ask(percept: Percept, config: Config) -> Witness:
        shown, its_config = parse_question(question(percept, config))  # copies that it may change
        values = run_or_fault(lambda: answer_with_claims(planner, shown, its_config))
        values = load_json(json.dumps(values).encode())
        if values.get("fault") in FAULTS:
            raise fault_of(values)
        return answer_of(values["answer"]), values

    return ask


def _false_claims(name: str, witness: dict[str, Any], percept: Percept) -> Iterator[tuple[str, str]]:
    """Yields each false claim of a decision, as (broken promise, description)."""
    claims = witness.get("claims")
    if not isinstance(claims, dict) or not isinstance(claims.get("options"), dict):
        yield "honest", "what its decision says cannot be read"
        return
    for key, who in (("name", "it calls itself"), ("planner", "its decision says that it is by")):
        if claims.get(key) != quote(name):
            yield "itself", f"{who} {_short(claims.get(key))}, and not {name}"
    forecast = predict(percept, 1)
    for move in Move:
        end = forecast.dynamics.target(percept.ego, move)
        reason, causes = forecast.check_step(percept.ego, end)
        cell = None if end is None else percept.road.cell(end)
        said = claims["options"].get(move.value)
        if not isinstance(said, list) or len(said) != 4:
            yield "honest", f"what it says of {move} cannot be read"
            continue
        so = [quote(reason.value), quote(cell), quote(tuple(sorted(causes)))]
        for what, claim, truth in zip(("", "to lead to ", "to be blocked by "), said, so, strict=False):
            if claim != truth:
                yield (
                    "honest",
                    f"{move} is said {what}{'to be ' if not what else ''}{_short(claim)}, not {truth}",
                )
        if reason.blocks and said[3] is not False:
            yield "honest", f"{move} is blocked and has a cost"


def _short(claim: object) -> str:
    return claim[:80] if isinstance(claim, str) else "something unreadable"
