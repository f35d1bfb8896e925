"""What a planner of another package may answer, and the decision that is made of it.

An answer is a move and six costs, as JSON: `{"move": "left", "costs": {"forward": null, "left": 2, ...}}`.
Nothing else is heard. Cells, verdicts, causes, the tick, the vehicle and the planner's name are made here,
from this project's forecast and from the question. What is not such an answer is a fault with a name.
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
"""Of one answer."""
MOST_COST: Final = 1e12
"""A cost is between this and its negative."""
MOST_TOLD: Final = 160
"""Characters of what a planner is quoted with."""

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
"""What a planner may do instead of answering, to follow its name. Its own words are in none of them."""

_KIND: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,59}")


class FaultError(Exception):
    """What a planner did instead of answering, to follow its name: "raised ValueError".

    `detail` is in its own words, for its author and nobody else.
    """

    def __init__(self, message: str, detail: str = "") -> None:
        super().__init__(message)
        self.detail = detail


class CodedError(FaultError):
    """A fault of those in `FAULTS`."""

    def __init__(self, code: str, kind: str = "", detail: str = "") -> None:
        super().__init__(FAULTS[code].format(kind=kind), detail)
        self.code, self.kind = code, kind


@dataclass(frozen=True, slots=True)
class Answer:
    """A move, and what each move costs, in the order of `Move`; None where the planner has no cost for it."""

    move: Move
    costs: tuple[float | None, ...]


def parsed(line: bytes) -> Answer:
    """The answer on a line. Raises `FaultError`, also where the line names a fault."""
    values = loaded(line)
    if "fault" in values:
        raise fault_of(values)
    return answer_of(values)


def loaded(line: bytes) -> dict[str, Any]:
    """The JSON object on a line, each key once and every number finite. Raises `FaultError`."""
    try:
        values = json.loads(
            line.decode("utf-8"), object_pairs_hook=_each_once, parse_constant=_no_number, parse_float=_number
        )
    except (ValueError, RecursionError):
        raise CodedError("no-json") from None
    if not isinstance(values, dict):
        raise CodedError("no-json")
    return values


def fault_of(values: Mapping[str, Any]) -> FaultError:
    """The fault that a planner's process tells of."""
    code, kind, detail = (values.get(key) for key in ("fault", "kind", "detail"))
    if not isinstance(code, str) or code not in FAULTS:
        return CodedError("no-json")
    known = isinstance(kind, str) and _KIND.fullmatch(kind)
    return CodedError(code, kind if known else "something", clean(detail))  # type: ignore[arg-type]


def answer_of(values: Mapping[str, Any]) -> Answer:
    """The answer of such values. Raises `FaultError`."""
    if set(values) != {"move", "costs"}:
        raise CodedError("more")
    move, costs = values["move"], values["costs"]
    if not isinstance(move, str) or move not in _MOVES:
        raise CodedError("no-move", detail=quoted(move))
    if not isinstance(costs, dict) or set(costs) != set(_MOVES):
        raise CodedError("no-verdicts")
    return Answer(_MOVES[move], tuple(checked_cost(costs[each.value], each) for each in Move))


def checked_cost(cost: object, move: Move) -> float | None:
    """A cost as a number. Raises `FaultError` for what is none, or none that can be."""
    if cost is None:
        return None
    detail = f"{quoted(cost)} for {move}"
    if isinstance(cost, bool) or not isinstance(cost, int | float):
        raise CodedError("no-number", detail=detail)
    if isinstance(cost, float) and not isfinite(cost):
        raise CodedError("not-finite", detail=detail)
    if not -MOST_COST <= cost <= MOST_COST:
        raise CodedError("too-large", detail=detail)
    return float(cost)


def decision_of(answer: Answer, percept: Percept, config: Config) -> Decision:
    """The decision: the planner's move and costs, and what this project's forecast says of each move.

    Cheapest first, a move without a cost last. Raises `FaultError` for a move that leads off the road
    or into another ego.
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


def quoted(value: object) -> str:
    """Something foreign, for a person: short, on one line, and of plain characters."""
    if isinstance(value, int) and abs(value) >= 10**40:
        return "a number of many digits"
    try:
        told = ascii(value)
    except BaseException:  # whatever its own `__repr__` does
        return f"a {type(value).__name__}"
    return told if len(told) <= MOST_TOLD // 2 else f"{told[: MOST_TOLD // 2]}..."


def clean(text: object) -> str:
    """Words of a planner's process, as above."""
    if not isinstance(text, str):
        return ""
    plain = "".join(each if each.isprintable() else " " for each in text[: MOST_TOLD + 1])
    return plain if len(plain) <= MOST_TOLD else f"{plain[:MOST_TOLD]}..."


def _each_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) != len(pairs):
        raise ValueError("a key stands twice")
    return values


def _no_number(name: str) -> Any:
    raise ValueError(f"{name} is no number")


def _number(digits: str) -> float:
    number = float(digits)
    if not isfinite(number):
        raise ValueError("a number is too large")
    return number
