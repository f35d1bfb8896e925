"""What a planner of another package may answer, and the decision that is made of it.

An answer is a move and six costs, as JSON: `{"move": "left", "costs": {"forward": null, "left": 2, ...}}`.
Nothing else is heard. Cells, verdicts, causes, the tick, the vehicle and the planner's name are made here,
from this project's forecast and from the question. What is not such an answer is a fault with a name.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Final

from sim.config import Config
from sim.forecast import foretell
from sim.kinds import Move
from sim.perceive import Percept
from sim.plan.decision import Decision, Measure, Option
from sim.plan.priority import options_in_order

MOST_BYTES: Final = 4_096
"""Of one answer."""
MOST_COST: Final = 1e12
"""A cost is between this and its negative."""
MOST_TOLD: Final = 160
"""Characters of what a planner is quoted with."""

_MOVES: Final = {move.value: move for move in Move}


class FaultError(Exception):
    """What a planner did instead of answering, to follow its name: "raised ValueError"."""


@dataclass(frozen=True, slots=True)
class Answer:
    """A move, and what each move costs, in the order of `Move`; None where the planner has no cost for it."""

    move: Move
    costs: tuple[float | None, ...]


def parsed(line: bytes) -> Answer:
    """The answer on a line. Raises `FaultError`, also where the line names a fault."""
    values = loaded(line)
    if set(values) == {"fault"}:
        raise FaultError(clean(values["fault"]))
    return answer_of(values)


def loaded(line: bytes) -> dict[str, Any]:
    """The JSON object on a line, each key once and every number finite. Raises `FaultError`."""
    try:
        values = json.loads(
            line.decode("utf-8"), object_pairs_hook=_each_once, parse_constant=_no_number, parse_float=_number
        )
    except (ValueError, RecursionError):
        raise FaultError("answered what is no JSON of an answer") from None
    if not isinstance(values, dict):
        raise FaultError("answered what is no JSON of an answer")
    return values


def answer_of(values: Mapping[str, Any]) -> Answer:
    """The answer of such values. Raises `FaultError`."""
    if set(values) != {"move", "costs"}:
        raise FaultError("answered something else than a move and costs")
    move, costs = values["move"], values["costs"]
    if not isinstance(move, str) or move not in _MOVES:
        raise FaultError(f"answered {quoted(move)}, which is no move")
    if not isinstance(costs, dict) or set(costs) != set(_MOVES):
        raise FaultError("answered without a cost for each of the six moves")
    return Answer(_MOVES[move], tuple(checked_cost(costs[each.value], each) for each in Move))


def checked_cost(cost: object, move: Move) -> float | None:
    """A cost as a number. Raises `FaultError` for what is none, or none that can be."""
    if cost is None:
        return None
    if isinstance(cost, bool) or not isinstance(cost, int | float):
        raise FaultError(f"answered with {quoted(cost)} as the cost of {move}, which is no number")
    if not -MOST_COST <= cost <= MOST_COST:  # false for what is no number, too
        told = "no finite number" if isinstance(cost, float) and not isfinite(cost) else "too large a number"
        raise FaultError(f"answered with {told} as the cost of {move}")
    return float(cost)


def decision_of(answer: Answer, percept: Percept, config: Config) -> Decision:
    """The decision: the planner's move and costs, and what this project's forecast says of each move.

    Cheapest first, a move without a cost last. Raises `FaultError` for a move that leads off the road.
    """
    if percept.road.moved(percept.ego, answer.move) is None:
        raise FaultError(f"answered {answer.move}, which leads off the road")
    costs = dict(zip(Move, answer.costs, strict=True))
    options = [
        Option(
            option.move,
            option.cell,
            option.reason,
            None if option.reason.blocks else costs[option.move],
            option.causes,
        )
        for option in options_in_order(foretell(percept, 1))
    ]
    options.sort(key=lambda option: (option.cost is None, option.cost or 0.0, option.move is not answer.move))
    return Decision(
        percept.tick, percept.ego_id, config.planner, answer.move, tuple(options), measure=Measure.OWN
    )


def quoted(value: object) -> str:
    """Something foreign, for a person: short, on one line, and of plain characters."""
    try:
        told = ascii(value)
    except BaseException:  # whatever its own `__repr__` does
        return f"a {type(value).__name__}"
    return told if len(told) <= MOST_TOLD // 2 else f"{told[: MOST_TOLD // 2]}..."


def clean(text: object) -> str:
    """A fault that a planner's process has told of, as above."""
    if not isinstance(text, str) or not text:
        return "answered what is no JSON of an answer"
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
