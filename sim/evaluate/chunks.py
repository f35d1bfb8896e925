"""Several pieces of work as one task, sized by what pieces have cost so far.

For executors to which every task costs time to hand out. Weights are episodes (or worlds), costs seconds.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final, Generic

from sim.evaluate.executor import Answer, Piece, Work, weight_of

LEAST: Final = 20_000
"""Fewest episodes of a task, where so many are asked for."""
TASK_S: Final = 5.0
"""Seconds that a task is made for, once costs are known."""
MOST_S: Final = 15.0
"""Seconds after which a task begins no other piece."""


@dataclass
class Costs:
    """What pieces have cost so far, by their weight: pieces of one weight are alike."""

    _seconds: dict[int, float] = field(default_factory=dict)
    _pieces: dict[int, int] = field(default_factory=dict)

    def add(self, weight: int, seconds: float) -> None:
        """Count a piece that took so long."""
        self._seconds[weight] = self._seconds.get(weight, 0.0) + seconds
        self._pieces[weight] = self._pieces.get(weight, 0) + 1

    def of(self, weight: int) -> float | None:
        """Seconds of a piece; None where none of that weight is done."""
        done = self._pieces.get(weight)
        return self._seconds[weight] / done if done else None


@dataclass(frozen=True)
class Done(Generic[Answer]):
    """What a task did: the answers to its first pieces, and the seconds that each took."""

    answers: Sequence[Answer]
    seconds: Sequence[float]


def take(left: list[Piece], slots: int, costs: Costs, asked: int) -> list[Piece]:
    """Takes the pieces of the next task off the list.

    They weigh at least `LEAST`, or an even share of what was asked for (`asked`) where that is less; more
    where they are known to cost little, as long as every one of the `slots` has two more tasks to do; and
    less where they are known to take longer than `MOST_S`.
    """
    least = LEAST if asked >= LEAST else -(-asked // slots)
    share = sum(map(weight_of, left)) // (2 * slots)
    given: list[Piece] = []
    weight, seconds = 0, 0.0
    while left:
        size = weight_of(left[0])
        cost = costs.of(size)
        if given:
            if weight >= least and (cost is None or seconds + cost > TASK_S or weight + size > share):
                break
            if cost is not None and seconds + cost > MOST_S:
                break
        given.append(left.pop(0))
        weight += size
        seconds += cost or 0.0
    return given


def run_task(work: Work[Piece, Answer], pieces: Sequence[Piece]) -> Done[Answer]:
    """Runs pieces one after the other; those that are not begun after `MOST_S` are left out."""
    answers: list[Answer] = []
    seconds: list[float] = []
    for piece in pieces:
        if answers and sum(seconds) > MOST_S:
            break
        began = time.perf_counter()
        answers.append(work(piece, _never))
        seconds.append(time.perf_counter() - began)
    return Done(answers, seconds)


def _never() -> bool:
    """A task is ended from outside, and is not told that it is cancelled."""
    return False
