"""The actions a model may cause, and their description for a prompt, generated from the contract.

The notation is that of TypeScript's types, a tenth of the length of JSON Schema and as well understood.
Which actions are offered is said in the table of actions, where the default is none: an action new to the
contract is out of a model's reach until its row says otherwise.
"""

from __future__ import annotations

import json
import re
from functools import cache
from typing import Any, Final, get_args

from service.actions import ACTIONS
from service.actions.table import ModelUse, verbs_where
from sim.actions import TimeOfDay, Traffic, Weather
from sim.planner_names import ALIASES, BUILT_IN, PROMISED
from sim.sensor_names import SensorName

MAY: Final = verbs_where(lambda traits: traits.model is not ModelUse.NEVER)
"""Actions that a model may cause, as the table of actions says."""

Json = dict[str, Any]
_ACTION = "Action"

_TYPES: Final[dict[str, Json]] = {
    name: part for name, part in ACTIONS.json_schema()["$defs"].items() if "oneOf" not in part
}
_DO: Final[dict[str, str]] = {
    name: part["properties"]["do"]["const"]
    for name, part in _TYPES.items()
    if "do" in part.get("properties", ())
}

FORBIDDEN: Final = frozenset(_DO.values()) - MAY
"""All other actions."""

WORDS: Final[dict[str, tuple[str, ...]]] = {
    "weather": get_args(Weather),
    "time_of_day": get_args(TimeOfDay),
    "traffic": get_args(Traffic),
    "planner": (*BUILT_IN, *PROMISED),
    "sensor": get_args(SensorName),
    "dynamics": ("grid", "continuous"),
}
"""The values of parameters that take words; all others take numbers."""

_UNIONS: Final[dict[str, tuple[str, str]]] = {
    "Kind": ("Add", "kind"),
    "Planner": ("FindWorst", "planner"),
    "Parameter": ("Set", "parameter"),
    "View": ("Show", "view"),
}
"""Unions that many fields have, each under its name: the type and the field that it is read from."""

_UNSPOKEN = frozenset(("ego", "fact"))
"""Fields that a model leaves out: no sentence names an ego, and facts are found by their own sentences."""


@cache
def schema() -> str:
    """The types that actions are made of, then the actions, one a line, each with what it does."""
    actions = [
        f"{_object(part)}  // {part['description'].splitlines()[0]}"
        for name, part in _TYPES.items()
        if _DO.get(name) in MAY
    ]
    types = {name: _type(part) for name, part in _TYPES.items() if name not in _DO}
    told = "\n".join((*actions, *types.values()))
    lines = [f"type {name} = {part}" for name, part in types.items() if re.search(rf"\b{name}\b", told)]
    lines += actions
    unions = {name: _type(_TYPES[of]["properties"][field]) for name, (of, field) in _UNIONS.items()}
    for name, union in unions.items():
        lines = [line.replace(union, name) for line in lines]
    lines = [*(f"type {name} = {union}" for name, union in unions.items()), *lines]
    lines += [f"values of {parameter}: {' '.join(words)}" for parameter, words in WORDS.items()]
    return "\n".join(lines)


def _object(part: Json) -> str:
    required = set(part.get("required", ()))
    fields = [
        f"{name}{'' if name in required or name == 'do' else '?'}: {_type(value)}"
        for name, value in part["properties"].items()
        if name not in _UNSPOKEN
    ]
    return "{" + ", ".join(fields) + "}"


def _type(part: Json) -> str:
    if "$ref" in part:
        name = str(part["$ref"].rpartition("/")[2])
        return name if name in _TYPES and name not in _DO else _ACTION
    if "oneOf" in part:
        return _ACTION
    if "anyOf" in part:
        return " | ".join(_type(one) for one in part["anyOf"] if one.get("type") != "null")
    if "const" in part:
        return json.dumps(part["const"])
    if "enum" in part:
        return " | ".join(json.dumps(value) for value in part["enum"] if value not in ALIASES)
    if "properties" in part:
        return _object(part)
    if part["type"] == "array":
        if "prefixItems" in part:
            return "[" + ", ".join(_type(one) for one in part["prefixItems"]) + "]"
        inner = _type(part["items"])
        return f"({inner})[]" if "|" in inner else f"{inner}[]"
    return _plain(part)


def _plain(part: Json) -> str:
    name = "int" if part["type"] == "integer" else str(part["type"])
    low, high, over = part.get("minimum"), part.get("maximum"), part.get("exclusiveMinimum")
    if over is not None:
        return f"{name} >{over}"
    if low is None:
        return name
    return f"{name} {low}..{high}" if high is not None else f"{name} >={low}"
