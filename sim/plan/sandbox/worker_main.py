"""The process of one planner of another package: what is done in it, from its beginning to its end.

Questions come and answers go on a socket of its own, a line each: a number, a space, JSON (`codec`,
`answer`). What the planner prints goes elsewhere. Limits are set before anything of it is loaded. All
that runs here is the planner's to spoil: whoever asks hears only what `answer` lets through.
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
from sim.plan.sandbox.answer import CodedError, checked_cost, clean, quoted
from sim.plan.sandbox.codec import CHECKED, asked, percept_values
from sim.planner_names import GROUP
from sim.types import Move

MOST_MEMORY: Final = 2**30
"""Bytes of address space."""
MOST_CPU_S: Final = 3_600
"""Seconds of processor time in the life of one process; it is stopped while it is not asked."""
MOST_FILE: Final = 64 * 2**20
"""Bytes of a file that it writes."""
MOST_FILES: Final = 256
NICE: Final = 10
"""So much later than the service is it given a processor where there are too few."""
MAX_HORIZON: Final = 10_000


def serve(target: str, line: int, printing: int) -> None:
    """Load the planner, then answer on the line until nobody asks any more. For a process of its own."""
    line = _settle(line, printing)
    with os.fdopen(os.dup(line), "rb") as questions:
        try:
            planner = EntryPoint("planner", target, GROUP).load()()
        except BaseException as error:  # sys.exit() among them
            _send(line, b"0", _told(_raised("unloadable", error)))
            return
        _send(line, b"0", {"ready": True})
        for each in questions:
            number, _, question = each.partition(b" ")
            in_full = question.startswith(CHECKED)
            work = partial(_answer, planner, question.removeprefix(CHECKED), in_full=in_full)
            _send(line, number, fault_met(work))


def answered(planner: Any, percept: Percept, config: Config) -> object:
    """What a planner decides of a forecast that reaches as far as it asks. Raises what it raises."""
    horizon = planner.horizon(config)
    if isinstance(horizon, bool) or not isinstance(horizon, int) or not 1 <= horizon <= MAX_HORIZON:
        raise CodedError("horizon", detail=quoted(horizon))
    return planner.decide(predict(percept, horizon), config)


def told(decision: object, percept: Percept) -> dict[str, Any]:
    """A decision's move and costs, as an answer. Raises `CodedError` where it is none for this moment."""
    if not isinstance(decision, Decision):
        raise CodedError("no-decision", detail=quoted(decision))
    move: object = decision.move
    if not isinstance(move, Move):
        raise CodedError("no-move", detail=quoted(move))
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
    """What a decision says beyond the move and costs, for who compares it with what is so."""
    return {
        "name": quoted(planner.name),
        "planner": quoted(decision.planner),
        "options": {
            option.move.value: [
                quoted(getattr(option.reason, "value", option.reason)),
                quoted(option.cell),
                quoted(tuple(sorted(option.causes))),
                option.cost is not None,
            ]
            for option in decision.options
        },
    }


def witnessed(planner: Any, percept: Percept, config: Config) -> dict[str, Any]:
    """An answer, with what the decision claims and whether the percept was changed. Raises `CodedError`."""
    shown = percept_values(percept)
    try:
        decision = answered(planner, percept, config)
    except IndexError as error:
        raise _raised("too-far" if "horizon" in str(error) else "raised", error) from error
    answer = told(decision, percept)
    assert isinstance(decision, Decision)  # else `told` raised
    return {
        "answer": answer,
        "claims": claims(planner, decision),
        "changed": percept_values(percept) != shown,
    }


def fault_met(work: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """What the work results in, or the fault that was met instead, whatever was raised."""
    try:
        return work()
    except CodedError as fault:
        return _told(fault)
    except BaseException as error:  # sys.exit() among them
        return _told(_raised("raised", error))


def _answer(planner: Any, asked_for: bytes, *, in_full: bool) -> dict[str, Any]:
    percept, config = asked(asked_for)
    return (
        witnessed(planner, percept, config) if in_full else told(answered(planner, percept, config), percept)
    )


def _cost(option: Option) -> float | None:
    cost: Any = option.cost
    if isinstance(cost, numbers.Real) and type(cost).__module__ != "builtins":
        cost = float(cost)  # of another library
    return checked_cost(cost, option.move)


def _told(fault: CodedError) -> dict[str, Any]:
    return {"fault": fault.code, "kind": fault.kind, "detail": fault.detail}


def _raised(code: str, error: BaseException) -> CodedError:
    try:
        text = str(error)
    except BaseException:  # whatever its own `__str__` does
        text = ""
    return CodedError(code, type(error).__name__, clean(text))


def _send(line: int, number: bytes, values: dict[str, Any]) -> None:
    data = b"%s %s\n" % (number, json.dumps(values, separators=(",", ":"), allow_nan=False).encode())
    while data:
        data = data[os.write(line, data) :]


def _settle(line: int, printing: int) -> int:
    """Set the limits, and keep no file but these; answers the line's new number."""
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
        with contextlib.suppress(OSError, ValueError):  # macOS knows no limit of address space
            resource.setrlimit(limit, (most, most))
    os.nice(NICE)
    end_with_parent()
    return 3


def end_with_parent() -> None:
    """On Linux, be killed when whoever asks has ended: who stands still would not see the line end."""
    if sys.platform == "linux":
        import ctypes
        import signal

        set_death_signal = 1
        call: Callable[..., int] = ctypes.CDLL(None).prctl
        call(set_death_signal, signal.SIGKILL)
