"""The one JSON encoder. Enumerations and dataclasses go as they are; tuples become arrays."""

from __future__ import annotations

from typing import Any

import orjson


def encoded(value: Any) -> bytes:
    """A value as JSON text in UTF-8."""
    return orjson.dumps(value)
