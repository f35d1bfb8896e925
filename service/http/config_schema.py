"""The documentation of a session's configuration, derived from `sim.config` so that it cannot drift."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from sim import planner_names, sensor_names
from sim.config import _WHOLE, CHOICES, LISTS, RANGES, Config


def _property(name: str, default: Any) -> dict[str, Any]:
    nullable = default is None
    if name in CHOICES:
        choices: list[str | None] = [*CHOICES[name], *([None] if nullable else [])]
        return {"enum": choices, "default": default}
    if name == "sensor":
        return {"enum": list(sensor_names.names()), "default": default}
    if name == "planner":
        examples = list(planner_names.names())
        return {"type": "string", "examples": examples, "default": default}
    if name in LISTS:
        items = {"type": "string", "enum": list(LISTS[name])}
        return {"type": "array", "items": items, "uniqueItems": True, "default": list(default)}
    if isinstance(default, bool):
        return {"type": "boolean", "default": default}
    low, high = RANGES[name]
    kind = "integer" if name in _WHOLE else "number"
    return {
        "type": [kind, "null"] if nullable else kind,
        "minimum": low,
        "maximum": high,
        "default": default,
    }


CONFIG_SCHEMA: dict[str, Any] = {
    "type": "object",
    "description": "Any part of a road's configuration; what is left out is at its default.",
    "properties": {field.name: _property(field.name, field.default) for field in fields(Config)},
    "additionalProperties": False,
}
