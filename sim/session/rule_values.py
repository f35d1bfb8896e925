"""Rules as JSON values and back, without the language contract: for work that is sent to other processes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from sim.actions import Trigger


def rule_values(rule: Trigger) -> dict[str, Any]:
    """A rule as JSON values, without what was left out."""
    values: dict[str, Any] = _pruned(asdict(rule))
    return values


def rule_of(values: Mapping[str, Any]) -> Trigger:
    """The rule of JSON values that `rule_values` made."""
    rule: Trigger = _read(Trigger, values)
    return rule


def _pruned(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _pruned(each) for name, each in value.items() if each is not None}
    if isinstance(value, list | tuple):
        return [_pruned(each) for each in value]
    return value


@cache
def _hints(kind: type) -> dict[str, Any]:
    return get_type_hints(kind)


def _read(hint: Any, value: Any) -> Any:
    """A value of a type: objects by their `do` where there are several, lists as tuples."""
    if get_origin(hint) is Annotated:
        return _read(get_args(hint)[0], value)
    choices = list(_choices(hint))
    if isinstance(value, Mapping):
        kind: Any = next(each for each in choices if is_dataclass(each) and _does(each, value))
        hints = _hints(kind)
        return kind(**{name: _read(hints[name], each) for name, each in value.items()})
    if isinstance(value, list | tuple):
        of = next((get_args(each)[0] for each in choices if get_origin(each) is tuple), Any)
        return tuple(_read(of, each) for each in value)
    return value


def _choices(hint: Any) -> Any:
    if get_origin(hint) is Annotated:
        yield from _choices(get_args(hint)[0])
    elif get_origin(hint) in (Union, UnionType):
        for each in get_args(hint):
            yield from _choices(each)
    else:
        yield hint


def _does(kind: Any, value: Mapping[str, Any]) -> bool:
    """Whether an object is of a class: by its `do`, or by the names of its fields."""
    known = {field.name: field for field in fields(kind)}
    if "do" in known or "do" in value:
        return "do" in known and bool(known["do"].default == value.get("do"))
    return set(value) <= set(known)
