"""The main program of a planner's process.

Questions and answers are lines on a socket: a number, a space, JSON (`codec`, `answer`). The planner's output
goes to a pipe. Limits are set before the planner is loaded. The planner can break anything in this process;
the other side accepts only what `answer` validates.
"""

from __future__ import annotations

import contextlib
import json
import numbers
import os
import resource
import sys
from collections.abc import Callable
from functools import partial
from importlib.metadata import EntryPoint
from typing import Any, Final

from sim.config import Config
from sim.forecast import predict
from sim.perceive import Percept
from sim.plan.decision import Decision, Option
from sim.plan.sandbox.answer import CodedError, check_cost, quote, sanitize
from sim.plan.sandbox.codec import CHECKED, parse_question, percept_values
from sim.planner_names import GROUP
from sim.types import Move

MOST_MEMORY: Final = 2**30
"""Most bytes of address space."""
MOST_CPU_S: Final = 3_600
"""Most processor time of one process in seconds; it is stopped while it is not asked."""
MOST_FILE: Final = 64 * 2**20
"""Most bytes of a file that it writes."""
MOST_FILES: Final = 256
NICE: Final = 10
"""Scheduling priority below the service's (`os.nice`)."""
MAX_HORIZON: Final = 10_000


def serve(target: str, line: int, printing: int) -> None:
    """Loads the planner and answers questions on the socket `line` until it closes. For its own process."""
    line = _confine(line, printing)
    with os.fdopen(os.dup(line), "rb") as questions:
        try:
            planner = EntryPoint("planner", target, GROUP).load()()
        except BaseException as error:  # includes sys.exit()
            _send(line, b"0", _fault_values(_fault_of_exception("unloadable", error)))
            return
        _send(line, b"0", {"ready": True})
        for each in questions:
            number, _, question = each.partition(b" ")
            in_full = question.startswith(CHECKED)
            work = partial(_answer, planner, question.removeprefix(CHECKED), in_full=in_full)
            _send(line, number, run_or_fault(work))


def ask_planner(planner: Any, percept: Percept, config: Config) -> object:
    """Calls the planner with a forecast of the horizon it asks for. Raises whatever the planner raises."""
    horizon = planner.horizon(config)
    if isinstance(horizon, bool) or not isinstance(horizon, int) or not 1 <= horizon <= MAX_HORIZON:
        raise CodedError("horizon", detail=quote(horizon))
    return planner.decide(predict(percept, horizon), config)


def answer_values(decision: object, percept: Percept) -> dict[str, Any]:
    """Extracts move and costs of a decision. Raises `CodedError` for anything but a decision on `percept`."""
    if not isinstance(decision, Decision):
        raise CodedError("no-decision", detail=quote(decision))
    move: object = decision.move
    if not isinstance(move, Move):
        raise CodedError("no-move", detail=quote(move))
    if (decision.tick, decision.av) != (percept.tick, percept.ego_id):
        raise CodedError("elsewhere")
    if predict(percept, 1).dynamics.target(percept.ego, move) is None:
        raise CodedError("off-road", detail=move)
    options: object = decision.options
    if (
        not isinstance(options, tuple)
        or not all(isinstance(option, Option) and isinstance(option.move, Move) for option in options)
        or sorted(option.move for option in options) != sorted(Move)
    ):
        raise CodedError("no-verdicts")
    return {"move": move.value, "costs": {each.move.value: _cost(each) for each in options}}


def claims(planner: Any, decision: Decision) -> dict[str, Any]:
    """Lists what a decision claims besides move and costs, for the conformance check."""
    return {
        "name": quote(planner.name),
        "planner": quote(decision.planner),
        "options": {
            option.move.value: [
                quote(getattr(option.reason, "value", option.reason)),
                quote(option.cell),
                quote(tuple(sorted(option.causes))),
                option.cost is not None,
            ]
            for option in decision.options
        },
    }


def answer_with_claims(planner: Any, percept: Percept, config: Config) -> dict[str, Any]:
    """Returns answer, claims, and whether the planner changed the percept. Raises `CodedError`."""
    shown = percept_values(percept)
    try:
        decision = ask_planner(planner, percept, config)
    except IndexError as error:
        raise _fault_of_exception("too-far" if "horizon" in str(error) else "raised", error) from error
    answer = answer_values(decision, percept)
    assert isinstance(decision, Decision)  # else `told` raised
    return {
        "answer": answer,
        "claims": claims(planner, decision),
        "changed": percept_values(percept) != shown,
    }


def run_or_fault(work: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Returns the result of `work`, or a fault for any exception."""
    try:
        return work()
    except CodedError as fault:
        return _fault_values(fault)
    except BaseException as error:  # sys.exit() among them
        return _fault_values(_fault_of_exception("raised", error))


def _answer(planner: Any, asked_for: bytes, *, in_full: bool) -> dict[str, Any]:
    percept, config = parse_question(asked_for)
    return (
        answer_with_claims(planner, percept, config)
        if in_full
        else answer_values(ask_planner(planner, percept, config), percept)
    )


def _cost(option: Option) -> float | None:
    cost: Any = option.cost
    if isinstance(cost, numbers.Real) and type(cost).__module__ != "builtins":
        cost = float(cost)  # a number type of another library
    return check_cost(cost, option.move)


def _fault_values(fault: CodedError) -> dict[str, Any]:
    return {"fault": fault.code, "kind": fault.kind, "detail": fault.detail}


def _fault_of_exception(code: str, error: BaseException) -> CodedError:
    try:
        text = str(error)
    except BaseException:  # whatever its own `__str__` does
        text = ""
    return CodedError(code, type(error).__name__, sanitize(text))


def _send(line: int, number: bytes, values: dict[str, Any]) -> None:
    data = b"%s %s\n" % (number, json.dumps(values, separators=(",", ":"), allow_nan=False).encode())
    while data:
        data = data[os.write(line, data) :]


def _confine(line: int, printing: int) -> int:
    """Sets the resource limits and closes all other files; returns the new descriptor of `line`."""
    kept = os.dup(line) if line < 4 else line
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    for number in (1, 2):
        os.dup2(printing, number)
    os.dup2(kept, 3)
    os.closerange(4, 4_096)
    for limit, most in (
        (resource.RLIMIT_AS, MOST_MEMORY),
        (resource.RLIMIT_CPU, MOST_CPU_S),
        (resource.RLIMIT_FSIZE, MOST_FILE),
        (resource.RLIMIT_NOFILE, MOST_FILES),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(limit)[1]
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        with contextlib.suppress(OSError, ValueError):  # macOS has no limit of address space
            resource.setrlimit(limit, (most, most))
    os.nice(NICE)
    end_with_parent()
    return 3


def end_with_parent() -> None:
    """On Linux, has this process killed when its parent ends; a stopped one would not see it."""
    if sys.platform == "linux":
        import ctypes
        import signal

        set_death_signal = 1
        call: Callable[..., int] = ctypes.CDLL(None).prctl
        call(set_death_signal, signal.SIGKILL)
