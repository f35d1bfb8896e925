"""Puts rules together from a request and its conditions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias, get_args

from pydantic import ValidationError

from service.actions import Action, Resume, dump, load
from service.grammar.rule_words import ONCE, TIMES, UNTIL, WHEN
from sim.actions import Add, Drive, RuleAction

Readings: TypeAlias = list[tuple[Action, ...]]

_RULE_ACTIONS = get_args(RuleAction)
_TIMES = ("after", "tick")
"""Ends that say how long a request lasts, which no single move or addition does."""


def rules_made(body: tuple[Action, ...], parts: Mapping[str, Any], *, keeps: bool) -> Readings:
    """The rule that a request and its conditions are, if they can be one.

    `keeps`: the request is one to go on with ("keep adding").
    """
    when, times = parts.get(WHEN) or parts.get(ONCE), parts.get(TIMES)
    until = _of_kind(parts.get(UNTIL), body)
    if when is None and until is not None and not keeps and body == (Resume(),):
        return _loaded([*dump(body), {"do": "trigger", "when": until, "then": [{"do": "pause"}], "times": 1}])
    if not all(isinstance(action, _RULE_ACTIONS) for action in body):
        return []
    keeps = keeps or (when is None and until is not None and until["fact"] not in _TIMES and _goes_on(body))
    if keeps and when is not None and when["fact"] != "every":
        return []
    if when is None:
        if not keeps or until is None:
            return []
        when = {"fact": "every", "ticks": 1}
    if ONCE in parts:
        if times is not None:
            return []
        times = 1
    rule = {"do": "trigger", "when": when, "then": dump(body)}
    return _loaded(
        [rule | {key: value for key, value in ((UNTIL, until), (TIMES, times)) if value is not None}]
    )


def with_more(rules: tuple[Action, ...], more: tuple[Action, ...]) -> Readings:
    """Rules of which the last one does more, if it can."""
    *before, last = dump(rules)
    if last["do"] != "trigger" or not all(isinstance(action, _RULE_ACTIONS) for action in more):
        return []
    return _loaded([*before, last | {"then": [*last["then"], *dump(more)]}])


def _goes_on(body: Sequence[Action]) -> bool:
    """Whether a request with an end is done until then: "drive left until …", "add a car until …"."""
    return all(isinstance(action, Drive) for action in body) or all(
        isinstance(action, Add) and action.count == 1 for action in body
    )


def needs_a_kind(condition: Any) -> bool:
    """Whether a condition is about a number of things and names no kind."""
    return isinstance(condition, Mapping) and condition.get("fact") == "count" and "kind" not in condition


def _of_kind(condition: Mapping[str, Any] | None, body: Sequence[Action]) -> Mapping[str, Any] | None:
    """A condition about a number of things; where it names no kind, they are those of the request."""
    if condition is None or not needs_a_kind(condition):
        return condition
    kinds = {getattr(action, "kind", None) for action in body}
    return {**condition, "kind": kinds.pop()} if len(kinds) == 1 and None not in kinds else condition


def adds_one(actions: tuple[Action, ...]) -> bool:
    """Whether each of some actions adds one thing."""
    return all(getattr(action, "count", None) == 1 for action in actions)


def one_at_a_time(readings: Readings) -> Readings:
    """Readings that add different numbers of the same things, as the one that adds one each time."""
    singles = [
        (replace(body[0], count=1),) for body in readings if len(body) == 1 and isinstance(body[0], Add)
    ]
    alike = len(singles) == len(readings) > 1 and len(set(singles)) == 1
    return [singles[0]] if alike else readings


def _loaded(values: Sequence[Mapping[str, Any]]) -> Readings:
    try:
        return [load(list(values))]
    except ValidationError:
        return []


def distinct(readings: Readings) -> Readings:
    """Each reading once, in their order."""
    return list(dict.fromkeys(readings))
