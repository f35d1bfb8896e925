"""Anybody's planner, put through its paces: every promise a planner makes, tried on many roads.

What is checked: its answers are legal decisions, in time; what it says of each move's cell is what the
forecast says, and the name on it is its own; it does not drive into what it knows while something is free;
the same question has the same answer, at once, after other questions and in another process; it changes
nothing it is given; it reads no further than the horizon it asked for. All defects are listed, not the first.
It is given a forecast of a percept and nothing else, so that there is no world for it to look at.

A planner of another package runs in a process of its own, as it does in a session (`worker`); what is true is
found out here, where it has no say.
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
    loaded,
    quoted,
)
from sim.plan.sandbox.codec import asked, question
from sim.planner_names import installed, refused
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

MAX_TOLD = 20
GIVE_UP: Final = 3
"""After so many questions in a row without an answer no more are asked."""
ASKED_ANEW: Final = 5
"""Questions that another process is asked."""

_LEGAL = frozenset(
    ("no-decision", "no-move", "elsewhere", "off-road", "no-verdicts", "no-number", "not-finite", "too-large")
)
_GRAVE = frozenset(
    ("died", "closed", "too-long", "out-of-turn", "no-json", "more", "unstartable", "unloadable")
)

Witness = tuple[Answer, dict[str, Any]]
"""An answer, and what the decision claims beside it."""
Ask = Callable[[Percept, Config], Witness]
"""Asks a planner. Raises `FaultError`, and `TimeoutError` where it does not answer in time."""
Tell = Callable[[str], None]
"""Told what is being done now."""


@dataclass(frozen=True, slots=True)
class Defect:
    """A promise that was not kept, and where."""

    promise: str
    """`legal`, `honest`, `itself`, `careful`, `deterministic`, `harmless`, `bounded`, `prompt`, `answers`"""
    seed: int
    tick: int
    what: str


@dataclass(frozen=True, slots=True)
class Report:
    """What was tried and found."""

    planner: str
    decisions: int
    defects: tuple[Defect, ...]
    untried: str | None = None
    """why nothing, or not all, was tried"""


def moments(roads: int = 20, ticks: int = 12) -> Iterator[SimState]:
    """Moments on roads of several sizes and densities, driven by the default planner."""
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
    """Try a planner on many moments. It is called in this process: hanging is for `check_apart`."""
    trial = _Trial(planner.name, _in_here(planner), tell=tell)
    trial.tried(moments() if runs is None else runs)
    return trial.report()


def check_apart(
    name: str, seconds: float = 60.0, runs: Iterable[SimState] | None = None, tell: Tell | None = None
) -> Report:
    """Try the installed planner of that name in a process of its own, for so long at most.

    Whatever it does, this ends, with what was found.
    """
    from sim.plan.sandbox.worker import SilentError, Worker

    until = time.monotonic() + seconds
    worker = Worker(name, installed()[name].value, memory=None)

    def ask(percept: Percept, config: Config) -> Witness:
        try:
            return worker.ask_in_full(percept, config).result(max(0.0, until - time.monotonic()))
        except SilentError as silence:
            raise TimeoutError(str(silence)) from silence

    trial = _Trial(name, ask, until, tell)
    try:
        if trial.tried(moments() if runs is None else runs):
            worker.stop()
            trial.asked_anew()
    finally:
        worker.stop()
    return trial.report()


def found(name: str) -> Planner | None:
    """The planner of this program that has that name."""
    return planner_named(name)


def claimed(name: str) -> list[Defect]:
    """What is wrong with the name itself: other packages that would have it, or a name that none may have."""
    return [
        Defect("itself", 0, 0, f"{where} asks for the name {other}, and is not used: {why}")
        for other, where, why in refused()
        if other == name
    ]


@dataclass
class _Trial:
    """One planner being tried."""

    name: str
    ask: Ask
    until: float = inf
    tell: Tell | None = None
    defects: list[Defect] = field(default_factory=list)
    answers: list[tuple[Percept, Config, Witness]] = field(default_factory=list)
    decisions: int = 0
    unanswered: int = 0
    untried: str | None = None

    def tried(self, runs: Iterable[SimState]) -> bool:
        """Try all moments, then ask again what was asked; whether it came to an end."""
        for state in runs:
            if self._over():
                return False
            self._say(f"road {state.config.seed + 1}, tick {state.world.tick}")
            self._moment(sense(state)[0], state.config)
        for number, (percept, config, before) in enumerate(reversed(self.answers), start=1):
            if self._over():
                return False
            self._say(f"asking again, {number} of {len(self.answers)}")
            self._again(percept, config, before, "after others")
        return True

    def asked_anew(self) -> None:
        """Ask some of it again, of what is another process by now."""
        for percept, config, before in self.answers[:ASKED_ANEW]:
            if self._over():
                return
            self._say("asking another process")
            self._again(percept, config, before, "by another process")

    def report(self) -> Report:
        """What was found."""
        return Report(self.name, self.decisions, tuple(self.defects), self.untried)

    def _over(self) -> bool:
        if self.untried is None and time.monotonic() >= self.until:
            self.untried = "the time is over"
        if self.untried is None and self.unanswered >= GIVE_UP:
            self.untried = f"it gave no answer {GIVE_UP} times in a row"
        return self.untried is not None

    def _say(self, doing: str) -> None:
        if self.tell is not None:
            self.tell(f"{doing}: {self.decisions} decisions, {len(self.defects)} defects")

    def _moment(self, percept: Percept, config: Config) -> None:
        self.decisions += 1
        witness = self._asked(percept, config)
        if witness is None:
            return
        answer, claims = witness
        try:
            decision = decision_of(answer, percept, config)
        except FaultError as fault:
            self._note("legal", percept, config, str(fault))
            return
        for promise, what in _untrue(self.name, claims, percept):
            self._note(promise, percept, config, what)
        if decision.chosen.reason.blocks and any(not option.reason.blocks for option in decision.options):
            what = f"{answer.move} is known to be blocked while another move is free"
            self._note("careful", percept, config, what)
        if claims.get("changed") is not False:
            self._note("harmless", percept, config, "what it was given was changed")
        self._again(percept, config, witness, "at once")
        self.answers.append((percept, config, witness))

    def _again(self, percept: Percept, config: Config, before: Witness, when: str) -> None:
        witness = self._asked(percept, config)
        if witness is not None and witness != before:
            what = f"the same question was answered differently {when}"
            self._note("deterministic", percept, config, what)

    def _asked(self, percept: Percept, config: Config) -> Witness | None:
        try:
            witness = self.ask(percept, config)
        except TimeoutError as late:
            if time.monotonic() < self.until:
                self.unanswered += 1
                self._note("prompt", percept, config, str(late))
            return None
        except FaultError as fault:
            code = fault.code if isinstance(fault, CodedError) else ""
            self.unanswered = self.unanswered + 1 if code in _GRAVE else 0
            promise = "bounded" if code == "too-far" else "legal" if code in _LEGAL else "answers"
            self._note(promise, percept, config, f"{fault}: {fault.detail}" if fault.detail else str(fault))
            if code == "unloadable":
                self.untried = "it could not be loaded"
            return None
        self.unanswered = 0
        return witness

    def _note(self, promise: str, percept: Percept, config: Config, what: str) -> None:
        self.defects.append(Defect(promise, config.seed, percept.tick, what))


def _in_here(planner: Planner) -> Ask:
    """Asks as its own process would, without one."""
    from sim.plan.sandbox.worker_main import fault_met, witnessed

    def ask(percept: Percept, config: Config) -> Witness:
        shown, its_config = asked(question(percept, config))  # its own, to do with as it likes
        values = fault_met(lambda: witnessed(planner, shown, its_config))
        values = loaded(json.dumps(values).encode())
        if values.get("fault") in FAULTS:
            raise fault_of(values)
        return answer_of(values["answer"]), values

    return ask


def _untrue(name: str, witness: dict[str, Any], percept: Percept) -> Iterator[tuple[str, str]]:
    """What a decision says that is not so, each with the promise it breaks."""
    claims = witness.get("claims")
    if not isinstance(claims, dict) or not isinstance(claims.get("options"), dict):
        yield "honest", "what its decision says cannot be read"
        return
    for key, who in (("name", "it calls itself"), ("planner", "its decision says that it is by")):
        if claims.get(key) != quoted(name):
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
        so = [quoted(reason.value), quoted(cell), quoted(tuple(sorted(causes)))]
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
