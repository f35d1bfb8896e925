"""Reads JSON values as the models of `service.contract`, tolerantly.

Keys and names that are not known here are passed over, so that a newer service can answer more.
"""

from __future__ import annotations

from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from service.client.errors import UnexpectedAnswer
from service.contract.model import Model

T = TypeVar("T", bound=Model)

_ADAPTERS: dict[type[Any], TypeAdapter[Any]] = {}
"""Made when they are first needed: each takes milliseconds."""


def read(kind: type[T], value: Any, where: str = "the answer") -> T:
    """A JSON value as `kind`. Raises `UnexpectedAnswer`, which names the first wrong value."""
    if kind not in _ADAPTERS:
        _ADAPTERS[kind] = TypeAdapter(kind)
    try:
        answer: T = _ADAPTERS[kind].validate_python(value, extra="ignore")
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join((where, *map(str, first["loc"])))
        raise UnexpectedAnswer(f"{place} is not as documented: {first['msg']}.") from None
    return answer
