"""Validates the answer of a planner of another package and makes a decision from it.

An answer is a move and six costs, as JSON: `{"move": "left", "costs": {"forward": null, "left": 2, ...}}`.
Nothing else is accepted. Cells, verdicts, causes, the tick, the ego and the planner's name come from this
project's forecast and from the question. Anything but an answer is a fault with a code (`FAULTS`).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Final

from sim.config import Config
from sim.forecast import predict
from sim.perceive import Percept
from sim.plan.decision import Decision, Measure, Option
from sim.plan.priority import options_in_order
from sim.types import Move

MOST_BYTES: Final = 4_096
"""Most bytes of one answer."""
MOST_COST: Final = 1e12
"""Largest absolute value of a cost."""
MOST_TOLD: Final = 160
"""Most characters of a quotation from a planner."""

_MOVES: Final = {move.value: move for move in Move}


FAULTS: Final = {
    "raised": "raised {kind}",
    "unloadable": "could not be loaded ({kind})",
    "unstartable": "could not be started",
    "horizon": "asked for a horizon that cannot be",
    "too-far": "read beyond its horizon",
    "no-decision": "answered what is no decision",
    "no-move": "answered what is no move",
    "elsewhere": "answered for another moment or vehicle",
    "off-road": "answered a move that leads off the road",
    "into-ego": "answered a move into another ego",
    "no-verdicts": "answered without a verdict on each of the six moves",
    "no-number": "answered a cost that is no number",
    "not-finite": "answered a cost that is no finite number",
    "too-large": "answered a cost that is too large a number",
    "no-json": "answered what is no JSON of an answer",
    "more": "answered something else than a move and six costs",
    "too-long": "answered at too great a length",
    "out-of-turn": "answered out of turn",
    "died": "took its process down ({kind})",
    "closed": "closed the line on which it was asked",
}
"""Faults by code; each message follows the planner's name and contains none of its words."""

_KIND: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,59}")


class FaultError(Exception):
    """A planner gave no valid answer; the message follows its name: "raised ValueError".

    `detail` contains the planner's own words, for its author only.
    """

    def __init__(self, message: str, detail: str = "") -> None:
        super().__init__(message)
        self.detail = detail


class CodedError(FaultError):
    """A fault with a code from `FAULTS`."""

    def __init__(self, code: str, kind: str = "", detail: str = "") -> None:
        super().__init__(FAULTS[code].format(kind=kind), detail)
        self.code, self.kind = code, kind


@dataclass(frozen=True, slots=True)
class Answer:
    """A move and the cost of each move in the order of `Move`; None for a move without a cost."""

    move: Move
    costs: tuple[float | None, ...]


def parse_answer(line: bytes) -> Answer:
    """Parses a line into an answer. Raises `FaultError`, also if the line reports a fault."""
    values = load_json(line)
    if "fault" in values:
        raise fault_of(values)
    return answer_of(values)


def load_json(line: bytes) -> dict[str, Any]:
    """Parses a JSON object with unique keys and finite numbers. Raises `FaultError`."""
    try:
        values = json.loads(
            line.decode("utf-8"),
            object_pairs_hook=_reject_duplicate_keys,
            parse_constant=_reject_constant,
            parse_float=_finite_float,
        )
    except (ValueError, RecursionError):
        raise CodedError("no-json") from None
    if not isinstance(values, dict):
        raise CodedError("no-json")
    return values


def fault_of(values: Mapping[str, Any]) -> FaultError:
    """Returns the fault that a planner's process reports."""
    code, kind, detail = (values.get(key) for key in ("fault", "kind", "detail"))
    if not isinstance(code, str) or code not in FAULTS:
        return CodedError("no-json")
    known = isinstance(kind, str) and _KIND.fullmatch(kind)
    return CodedError(code, kind if known else "something", sanitize(detail))  # type: ignore[arg-type]


def answer_of(values: Mapping[str, Any]) -> Answer:
    """Validates parsed values as an answer. Raises `FaultError`."""
    if set(values) != {"move", "costs"}:
        raise CodedError("more")
    move, costs = values["move"], values["costs"]
    if not isinstance(move, str) or move not in _MOVES:
        raise CodedError("no-move", detail=quote(move))
    if not isinstance(costs, dict) or set(costs) != set(_MOVES):
        raise CodedError("no-verdicts")
    return Answer(_MOVES[move], tuple(check_cost(costs[each.value], each) for each in Move))


def check_cost(cost: object, move: Move) -> float | None:
    """Returns a cost as a float, or None. Raises `FaultError` for anything but a finite number in range."""
    if cost is None:
        return None
    detail = f"{quote(cost)} for {move}"
    if isinstance(cost, bool) or not isinstance(cost, int | float):
        raise CodedError("no-number", detail=detail)
    if isinstance(cost, float) and not isfinite(cost):
        raise CodedError("not-finite", detail=detail)
    if not -MOST_COST <= cost <= MOST_COST:
        raise CodedError("too-large", detail=detail)
    return float(cost)


def decision_of(answer: Answer, percept: Percept, config: Config) -> Decision:
    """Combines the planner's move and costs with the verdicts of this project's forecast into a decision.

    Options are sorted by cost, those without a cost last. Raises `FaultError` for a move off the road or into
    another ego.
    """
    if config.ego_dynamics(percept.road).target(percept.ego, answer.move) is None:
        raise CodedError("off-road", detail=answer.move)
    forecast = predict(percept, 1)
    if forecast.meets_ego(answer.move):
        raise CodedError("into-ego", detail=answer.move)
    costs = dict(zip(Move, answer.costs, strict=True))
    options = [
        Option(
            option.move,
            option.cell,
            option.reason,
            None if option.reason.blocks else costs[option.move],
            option.causes,
        )
        for option in options_in_order(forecast)
    ]
    options.sort(key=lambda option: (option.cost is None, option.cost or 0.0, option.move is not answer.move))
    return Decision(
        percept.tick, percept.ego_id, config.planner, answer.move, tuple(options), measure=Measure.OWN
    )


def quote(value: object) -> str:
    """Formats any object of a planner for a person: short, on one line, in ASCII."""
    if isinstance(value, int) and abs(value) >= 10**40:
        return "a number of many digits"
    try:
        told = ascii(value)
    except BaseException:  # whatever its own `__repr__` does
        return f"a {type(value).__name__}"
    return told if len(told) <= MOST_TOLD // 2 else f"{told[: MOST_TOLD // 2]}..."


def sanitize(text: object) -> str:
    """Limits text from a planner's process to one short printable line; other values become an empty text."""
    if not isinstance(text, str):
        return ""
    plain = "".join(each if each.isprintable() else " " for each in text[: MOST_TOLD + 1])
    return plain if len(plain) <= MOST_TOLD else f"{plain[:MOST_TOLD]}..."


def _reject_duplicate_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) != len(pairs):
        raise ValueError("a key stands twice")
    return values


def _reject_constant(name: str) -> Any:
    raise ValueError(f"{name} is no number")


def _finite_float(digits: str) -> float:
    number = float(digits)
    if not isfinite(number):
        raise ValueError("a number is too large")
    return number
