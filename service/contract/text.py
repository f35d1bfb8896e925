"""Text that every kind of store can hold: all of Unicode but U+0000, which PostgreSQL cannot store.

A request with U+0000 is refused, so that a session can be moved from one kind of store to another.
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, Field, ValidationError
from pydantic_core import PydanticCustomError

_NUL = "\0"


def _wrong() -> PydanticCustomError:
    return PydanticCustomError("no_text", "must not hold the character U+0000")


def _checked(text: str) -> str:
    if _NUL in text:
        raise _wrong()
    return text


_SCHEMA = {"pattern": "^[^\\u0000]*$"}

StorableText = Annotated[str, Field(json_schema_extra=_SCHEMA), AfterValidator(_checked)]
"""A text without U+0000, which every kind of store can hold."""

Name = Annotated[str, Field(min_length=1, max_length=80, json_schema_extra=_SCHEMA), AfterValidator(_checked)]
"""What somebody calls a session."""


def check_letters(values: Any) -> None:
    """Raise `pydantic.ValidationError` for JSON values with such a text in them, naming the first."""
    place = _place(values)
    if place is not None:
        wrong = {"type": _wrong(), "loc": tuple(place), "input": None}
        raise ValidationError.from_exception_data("actions", [wrong])  # type: ignore[list-item]


def _place(value: Any) -> list[str | int] | None:
    if isinstance(value, str):
        return [] if _NUL in value else None
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, each in inner:
        found = _place(each)
        if found is not None:
            return [key, *found]
    return None
