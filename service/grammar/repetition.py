"""Requests that are done several times: "turn left twice", "add a car, and do that three times"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from service.actions import Action, Step
from sim.actions import Add, Adjust, Copy, Drive, Remove

_ADDS_UP = (Add, Remove, Copy, Adjust, Drive, Step)
"""Actions that do more when they are done again; "restart twice" is no more than "restart"."""

MAX_REPEATED = 50
"""How many actions a repeated request comes to at most."""


def may_be_repeated(request: Sequence[Action]) -> bool:
    """Whether a request is one that may be done several times: each time changes something more.

    What points at one thing is not: "copy that pothole twice" may mean the copy the second time.
    """
    wheres = [getattr(action, "where", None) for action in request]
    points = any(where is not None and (where.nearest or where.id) for where in wheres)
    return not points and all(isinstance(action, _ADDS_UP) for action in request)


def repeated(request: tuple[Action, ...], times: int) -> tuple[Action, ...]:
    """A request so many times; things anywhere are added all at once."""
    first = request[0]
    if len(request) == 1 and isinstance(first, Add) and first.where is None:
        return (replace(first, count=first.count * times),)
    return request * times


def counts_of(said: Mapping[str, int]) -> list[int]:
    """How often a request is done in all, by what is said after it.

    `total` counts the first time, `more` does not; `either` may be both.
    """
    (way, times), *_ = said.items()
    return {"total": [times], "more": [times + 1]}.get(way, [times, times + 1])


def parts_of(actions: Sequence[Action]) -> tuple[tuple[Action, ...], int]:
    """The shortest request that actions are repetitions of, and how many they are."""
    size = len(actions)
    for length in range(1, size + 1):
        times, left = divmod(size, length)
        if not left and tuple(actions[:length]) * times == tuple(actions):
            return tuple(actions[:length]), times
    return tuple(actions), 1
