"""Parses a model's answer into actions, or rejects it.

The answer is untrusted data: the user's text may have tried to make the model say something. Actions that
pass are validated like any others; what a session can do with them is up to the session.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import from_json

from service.actions import Action, Ask, Evaluate, load
from service.llm.failures import ModelFailure
from service.llm.schema import FORBIDDEN, WORDS
from sim.actions import (
    Add,
    Copy,
    Drive,
    Landmark,
    MoveThings,
    Remove,
    Replace,
    Set,
    SetMode,
    Swap,
    Where,
)

MAX_ACTIONS: Final = 8
"""Largest number of actions in one answer, nested ones included."""

_FENCED = re.compile(r"```[a-zA-Z]*\n?(.*?)```", re.DOTALL)


def parse_answer(answer: str, said: str) -> tuple[Action, ...]:
    """The actions in an answer to a text. Raises `ModelFailure`."""
    try:
        values = from_json(_object_in(answer), allow_inf_nan=False)
    except ValueError as error:
        raise ModelFailure("unreadable", again=True) from error
    if not isinstance(values, dict) or set(values) != {"actions"} or not isinstance(values["actions"], list):
        raise ModelFailure("no_action", again=True)
    _check_names(values["actions"])
    try:
        actions = load(values["actions"])
    except ValidationError as error:
        raise ModelFailure("no_action", again=True) from error
    for action in actions:
        _check(action, said)
    if not actions:
        raise ModelFailure("nothing")
    return actions


def _object_in(answer: str) -> str:
    """The JSON object of an answer, without a code fence and words around it."""
    fenced = _FENCED.findall(answer)
    inside = fenced[0] if len(fenced) == 1 else answer
    return str(inside[inside.find("{") : inside.rfind("}") + 1])


def _check_names(values: list[Any]) -> None:
    """Check the number and the names of the actions, before they are parsed."""
    if any(isinstance(value, float) and not isfinite(value) for value in _inside(values)):
        raise ModelFailure("no_action", again=True)
    names = [value["do"] for value in _inside(values) if isinstance(value, dict) and "do" in value]
    if max(len(values), len(names)) > MAX_ACTIONS:
        raise ModelFailure("too_many", most=MAX_ACTIONS)
    for name in names:
        if isinstance(name, str) and name in FORBIDDEN:
            raise ModelFailure("forbidden", name=name)


def _inside(value: Any) -> Iterator[Any]:
    """All values nested in a value, itself included; iterative, since the depth is unbounded."""
    way = [value]
    while way:
        here = way.pop()
        yield here
        if isinstance(here, dict):
            way.extend(here.values())
        elif isinstance(here, list):
            way.extend(here)


def _check(action: Action, said: str) -> None:
    """Check fields that take any text: only words of the contract, and ids that the user said."""
    match action:
        case Set(parameter=parameter, value=value):
            words = WORDS.get(parameter)
            fits = isinstance(value, str) if words else not isinstance(value, str)
            if not fits or (words and value not in words):
                raise ModelFailure("no_action", again=True)
        case Add() | Remove() | MoveThings() | Swap() | Replace() | Copy():
            if any(not _was_said(name, said) for name in _ids(action)):
                raise ModelFailure("not_said")
        case Drive(ego=str(ego)) | SetMode(ego=str(ego)):
            if not _was_said(ego, said):
                raise ModelFailure("not_said")
        case Evaluate(scenario_name=str(name)):
            if name.casefold() not in said.casefold():
                raise ModelFailure("not_said")
        case Ask(change=tuple(change)):
            for inner in change:
                if isinstance(inner, Ask):
                    raise ModelFailure("no_action", again=True)
                _check(inner, said)
        case _:
            pass


def _ids(part: object) -> Iterator[str]:
    """Every id in the places of an action."""
    if isinstance(part, Where | Landmark) and part.id is not None:
        yield part.id
    if is_dataclass(part):
        for field in fields(part):
            yield from _ids(getattr(part, field.name))


def _was_said(thing: str, said: str) -> bool:
    """Whether an id is in a text, as "pothole-3" or "pothole 3"."""
    kind, mark, number = thing.rpartition("-")
    if not (mark and kind.isalpha() and number.isdecimal()):
        return False
    return re.search(rf"\b{kind}[\s-]*{number}\b", said, re.IGNORECASE) is not None
