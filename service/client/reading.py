"""Reads JSON values as the models of `service.contract`, tolerantly.

Keys and names that are not known here are passed over, so that a newer service can answer more.
"""

from __future__ import annotations

import functools
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from service.client.errors import UnexpectedAnswer

T = TypeVar("T")


def read(kind: type[T], value: Any, where: str = "the answer") -> T:
    """A JSON value as `kind`. Raises `UnexpectedAnswer`, which names the first wrong value."""
    try:
        return _adapter(kind).validate_python(value, extra="ignore")
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join((where, *map(str, first["loc"])))
        raise UnexpectedAnswer(f"{place} is not as documented: {first['msg']}.") from None


@functools.cache
def _adapter(kind: type[T]) -> TypeAdapter[T]:
    return TypeAdapter(kind)
