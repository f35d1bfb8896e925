"""Encodes the question to a planner's process as JSON: a percept and a configuration, field by field.

The codec is generic over the fields of both, so a new field needs no change here. Integers that a JSON reader
may round (boards) are hexadecimal strings. Answers are in `answer`.
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
"""Integers below this are exact in every JSON reader."""
CHECKED: Final = b"check "
"""Prefix of a question that wants the full answer with its claims (`sim.plan.conformance`)."""


def question(percept: Percept, config: Config) -> bytes:
    """Encodes a question as one line of JSON without its line end; equal questions give equal bytes."""
    values = {"percept": percept_values(percept), "config": asdict(config)}
    return json.dumps(values, separators=(",", ":"), allow_nan=False).encode()


def parse_question(line: bytes | str) -> tuple[Percept, Config]:
    """Decodes a question into new objects. Raises `ValueError`, `TypeError` or `LookupError`."""
    values = json.loads(line)
    return percept_of(values["percept"]), Config().with_parts(**values["config"])


def percept_values(percept: Percept) -> dict[str, Any]:
    """Converts the fields of a percept to JSON values. Raises `TypeError` for an unknown type."""
    return {field.name: _to_json(getattr(percept, field.name)) for field in fields(percept)}


def percept_of(values: Mapping[str, Any]) -> Percept:
    """Converts JSON values back to a percept."""
    kinds = _percept_types()
    parts: dict[str, Any] = {}
    for name, value in values.items():
        part, kind = _from_json(value), kinds.get(name)
        parts[name] = kind(part) if isinstance(kind, type) and issubclass(kind, Enum) else part
    parts["egos"] = tuple(
        OtherEgo(id, cell, Move(move), parked) for id, cell, move, parked in parts.get("egos", ())
    )
    return Percept(**parts)


@cache
def _percept_types() -> dict[str, Any]:
    return get_type_hints(Percept)


def _to_json(value: object) -> Any:
    if value is None or isinstance(value, bool | float | str):
        return value.value if isinstance(value, Enum) else value
    if isinstance(value, int):
        return value if -EXACT < value < EXACT else {"hex": hex(value)}
    if isinstance(value, Boards):
        return {"boards": [_to_json(board) for board in value.by_kind]}
    if isinstance(value, Road):
        return {"road": [value.columns, value.rows]}
    if isinstance(value, Mapping):
        return {"map": [[_to_json(key), _to_json(each)] for key, each in value.items()]}
    if isinstance(value, tuple | list):
        return {"list": [_to_json(each) for each in value]}
    raise TypeError(f"a percept cannot be told with {type(value).__name__} in it")


def _from_json(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    ((kind, content),) = value.items()
    if kind == "hex":
        return int(content, 16)
    if kind == "boards":
        return Boards.in_order([_from_json(board) for board in content])
    if kind == "road":
        return Road.of(*content)
    if kind == "map":
        return {_from_json(key): _from_json(each) for key, each in content}
    if kind == "list":
        return tuple(_from_json(each) for each in content)
    raise ValueError(f"there is no kind of value called {kind!r}")
