"""How a JSON value becomes a frozen dataclass, by the dataclass's own annotations.

Keys that are not known are kept in `raw`, so that a newer service can say more; a key that is missing, or
of another type, is `UnexpectedAnswer`, which says where.
"""

from __future__ import annotations

import functools
import types
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from typing import Any, Generic, TypeVar, Union, get_args, get_origin, get_type_hints

from service.client.errors import UnexpectedAnswer

Json = Mapping[str, Any]
T = TypeVar("T")


@dataclass(frozen=True, kw_only=True)
class Result:
    """Something answered; `raw` is all of it, as it came."""

    raw: Json = field(default_factory=dict, repr=False, compare=False)


@dataclass(frozen=True)
class Page(Generic[T]):
    """Part of a list; send `after` for what follows, if there is `more`."""

    items: tuple[T, ...]
    after: Any
    more: bool

    def __iter__(self) -> Iterator[T]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


def read(kind: Any, value: Any, where: str = "the answer") -> Any:
    """A JSON value as `kind`. Raises `UnexpectedAnswer`, saying where."""
    if kind is Any:
        return value
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        known = [each for each in inner if each is not type(None)]
        if value is None:
            return None
        words = str in known and isinstance(value, str)
        return value if words else read(known[0], value, where)
    if origin is tuple:
        _check(isinstance(value, list), where, "a list", value)
        if inner[-1] is Ellipsis:
            return tuple(read(inner[0], item, f"{where}.{number}") for number, item in enumerate(value))
        _check(len(value) == len(inner), where, f"{len(inner)} values", value)
        return tuple(
            read(each, item, f"{where}.{number}")
            for number, (each, item) in enumerate(zip(inner, value, strict=True))
        )
    if origin is not None and issubclass(origin, Mapping):
        _check(isinstance(value, dict), where, "an object", value)
        return {key: read(inner[1], item, f"{where}.{key}") for key, item in value.items()}
    if is_dataclass(kind):
        return _object(kind, value, where)
    expected = (int, float) if kind is float else kind
    right = isinstance(value, expected) and (kind is bool or not isinstance(value, bool))
    _check(right, where, kind.__name__, value)
    return value


def read_page(kind: type[T], value: Any) -> Page[T]:
    """A JSON page of `kind`."""
    _check(isinstance(value, dict) and isinstance(value.get("items"), list), "the answer", "a page", value)
    items = tuple(read(kind, item, f"items.{number}") for number, item in enumerate(value["items"]))
    return Page(items, value.get("after"), bool(value.get("more")))


def _object(kind: Any, value: Any, where: str) -> Any:
    _check(isinstance(value, dict), where, "an object", value)
    given: dict[str, Any] = {}
    for name, key, hint, optional in _members(kind):
        if name == "raw":
            given[name] = value
        elif key in value:
            given[name] = read(hint, value[key], f"{where}.{key}")
        elif not optional:
            raise UnexpectedAnswer(f"{where} has no {key}")
    return kind(**given)


@functools.cache
def _members(kind: Any) -> list[tuple[str, str, Any, bool]]:
    """Name, JSON key, type and whether it may be left out, of each field."""
    hints = get_type_hints(kind)
    return [
        (
            each.name,
            each.metadata.get("key", each.name),
            hints[each.name],
            each.default is not MISSING or each.default_factory is not MISSING,
        )
        for each in fields(kind)
    ]


def _check(right: bool, where: str, expected: str, value: Any) -> None:
    if not right:
        raise UnexpectedAnswer(f"{where} should be {expected}, and is {str(value)[:60]!r}")
