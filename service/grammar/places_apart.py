"""Whether two places, each as parts of a `where`, are surely not the same one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_LEFTMOST = "left"
"""The lane that is lane 1, however many there are."""


def are_apart(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether a part that both name differs; the middle lane may well be lane 2."""
    return any(_differ(key, one[key], value) for key, value in other.items() if key in one)


def _differ(key: str, one: object, other: object) -> bool:
    if isinstance(one, str) == isinstance(other, str):
        return one != other
    named, number = (one, other) if isinstance(one, str) else (other, one)
    return key == "lane" and named == _LEFTMOST and number != 1
