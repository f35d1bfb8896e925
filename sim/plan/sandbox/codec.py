"""What a planner's process is asked, as JSON: a percept and a configuration, field by field.

Generic over the fields of both, so that a new one is carried without a change here. Numbers that a JSON
reader may round (boards are sets of cells) travel as hexadecimal digits. Leaves out the answer: see `answer`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from enum import Enum
from functools import cache
from typing import Any, Final, get_type_hints

from sim.config import Config
from sim.perceive import OtherEgo, Percept
from sim.types import Move
from sim.world.boards import Boards
from sim.world.grid import Road

EXACT: Final = 2**53
"""Whole numbers below this are exact in every JSON reader."""
CHECKED: Final = b"check "
"""Stands before a question whose answer is to be told in full (`sim.plan.conformance`)."""


def question(percept: Percept, config: Config) -> bytes:
    """One line of JSON, without its end: the same for the same question."""
    values = {"percept": percept_values(percept), "config": asdict(config)}
    return json.dumps(values, separators=(",", ":"), allow_nan=False).encode()


def asked(line: bytes | str) -> tuple[Percept, Config]:
    """What a question is about, made anew. Raises `ValueError`, `TypeError` or `LookupError`."""
    values = json.loads(line)
    return percept_of(values["percept"]), Config().with_parts(**values["config"])


def percept_values(percept: Percept) -> dict[str, Any]:
    """A percept's fields as JSON values. Raises `TypeError` for one of a kind that is not known here."""
    return {field.name: _values(getattr(percept, field.name)) for field in fields(percept)}


def percept_of(values: Mapping[str, Any]) -> Percept:
    """The percept of such values."""
    kinds = _kinds()
    parts: dict[str, Any] = {}
    for name, value in values.items():
        part, kind = _back(value), kinds.get(name)
        parts[name] = kind(part) if isinstance(kind, type) and issubclass(kind, Enum) else part
    parts["egos"] = tuple(
        OtherEgo(id, cell, Move(move), parked) for id, cell, move, parked in parts.get("egos", ())
    )
    return Percept(**parts)


@cache
def _kinds() -> dict[str, Any]:
    return get_type_hints(Percept)


def _values(value: object) -> Any:
    if value is None or isinstance(value, bool | float | str):
        return value.value if isinstance(value, Enum) else value
    if isinstance(value, int):
        return value if -EXACT < value < EXACT else {"hex": hex(value)}
    if isinstance(value, Boards):
        return {"boards": [_values(board) for board in value.by_kind]}
    if isinstance(value, Road):
        return {"road": [value.columns, value.rows]}
    if isinstance(value, Mapping):
        return {"map": [[_values(key), _values(each)] for key, each in value.items()]}
    if isinstance(value, tuple | list):
        return {"list": [_values(each) for each in value]}
    raise TypeError(f"a percept cannot be told with {type(value).__name__} in it")


def _back(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    ((kind, content),) = value.items()
    if kind == "hex":
        return int(content, 16)
    if kind == "boards":
        return Boards.in_order([_back(board) for board in content])
    if kind == "road":
        return Road.of(*content)
    if kind == "map":
        return {_back(key): _back(each) for key, each in content}
    if kind == "list":
        return tuple(_back(each) for each in content)
    raise ValueError(f"there is no kind of value called {kind!r}")
