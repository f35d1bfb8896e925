"""Finds a place at one end of a list that may hold for all of it: "remove cars and cones in lane 2".

The list has one verb, and only one of its parts has a place. Whether that place is meant for the others
too cannot be told, so both readings are offered.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from service.grammar.clause import PLACED, Clause
from service.grammar.fragments import AND, PAUSE
from service.grammar.lattice import Edge

_PLACING = ("add", "remove", "copy")
"""Actions that may have a place or none."""

_COUNTED = "thing.counted"
"""Concept of amounts that are a number of things."""

_SHARED = ("lane", "lanes", "row", "rows", "side", "cell", "cells", "distance_m", "of")
"""Parts of a place where several things may be."""

Actions = list[dict[str, Any]]


def place_for_all(clauses: Sequence[Clause]) -> tuple[Actions, Actions] | None:
    """The actions with the place for the whole list, and as they stand; None where no list shares one."""
    said = [action for clause in clauses for action in clause.actions]
    for first, last in _lists(clauses):
        part = clauses[first:last]
        where = _one_place(part)
        if where is None:
            continue
        listed = [
            action if "where" in action else {**action, "where": where}
            for clause in part
            for action in clause.actions
        ]
        before = [action for clause in clauses[:first] for action in clause.actions]
        after = [action for clause in clauses[last:] for action in clause.actions]
        return [*before, *listed, *after], said
    return None


def _lists(clauses: Sequence[Clause]) -> list[tuple[int, int]]:
    """Stretches of requests of which only the first has a verb, as bounds."""
    found: list[tuple[int, int]] = []
    first = 0
    for at in range(1, len(clauses) + 1):
        if at < len(clauses) and _goes_on(clauses[at]):
            continue
        if at - first > 1:
            found.append((first, at))
        first = at
    return found


def _goes_on(clause: Clause) -> bool:
    """Whether a clause has its verb from the one before it."""
    slots = clause.filled.slots
    handed_on = any(edge.start < clause.start for edge in slots)
    return handed_on and clause.after in (AND, PAUSE) and not any(_names_no_thing(edge) for edge in slots)


def _names_no_thing(edge: Edge) -> bool:
    """Whether an amount has its noun from before: the "one" of "two cars, and one in lane 3"."""
    return edge.concept == _COUNTED and edge.end == edge.start + 1


def _one_place(clauses: Sequence[Clause]) -> Mapping[str, Any] | None:
    """The place that is said at one end of a list and nowhere else in it."""
    actions = [action for clause in clauses for action in clause.actions]
    if len({action["do"] for action in actions}) != 1 or actions[0]["do"] not in _PLACING:
        return None
    placed = [clause for clause in clauses if any("where" in action for action in clause.actions)]
    if len(placed) != 1 or any("except" in action for action in actions):
        return None
    (clause,) = placed
    # The first has it at its end in "remove the cones in lane 2 and the cars", and then alone.
    end = clause is clauses[-1] or (clause is clauses[0] and _place_comes_first(clause))
    where = clause.actions[0].get("where")
    shared = isinstance(where, Mapping) and set(where) <= set(_SHARED)
    return where if end and shared else None


def _place_comes_first(clause: Clause) -> bool:
    """Whether a place stands before everything else."""
    slots = sorted(clause.filled.slots, key=lambda edge: edge.start)
    return bool(slots) and slots[0].concept in PLACED
