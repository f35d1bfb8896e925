"""Suggestions for unknown keys and words in bodies and messages.

pydantic names the key that it refuses and not those it accepts; they are looked up in the type that it
validated, at the place of the key. (Its JSON schema knows as well, and takes 40 ms to make.)
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import is_dataclass
from functools import lru_cache
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel

from service.suggestions import nearest

MAX_KEY_CHARS = 60
"""Longer keys are no typing errors."""

_TAGS = ("do", "type")
"""Keys by which the members of a union are told apart."""
_QUOTED = re.compile(r"'([^']*)'")


def suggest(name: Any, known: Iterable[str]) -> str:
    """The end of a sentence that names what may have been meant; empty if nothing is near."""
    found = nearest(name, known) if isinstance(name, str) and len(name) <= MAX_KEY_CHARS else None
    return f"; did you mean {found}" if found else ""


def suggest_quoted(name: Any, listed: str) -> str:
    """The same, of names that are listed in quotation marks."""
    return suggest(name, _QUOTED.findall(listed))


def keys(kind: Any, sent: Any, path: Sequence[str | int]) -> Collection[str]:
    """The keys that a type accepts at a path in what was `sent`."""
    kinds = list(_alternatives(kind, sent))
    for part in path:
        sent = sent[part]
        inner = [get_args(each)[:1] if isinstance(part, int) else _member(each, part) for each in kinds]
        kinds = [each for found in inner for one in found for each in _alternatives(one, sent)]
    return {name for each in kinds for name in _members(each)}


def _alternatives(kind: Any, sent: Any) -> Iterator[Any]:
    """A type, or the members of a union that may be meant."""
    origin = get_origin(kind)
    if origin is Annotated:
        yield from _alternatives(get_args(kind)[0], sent)
    elif origin in (Union, UnionType):
        for each in get_args(kind):
            yield from _alternatives(each, sent)
    elif not isinstance(sent, dict) or all(
        sent.get(tag) in (None, *get_args(hint)) for tag, hint in _members(kind).items() if tag in _TAGS
    ):
        yield kind


def _member(kind: Any, name: str) -> tuple[Any, ...]:
    hint = _members(kind).get(name)
    return () if hint is None else (hint,)


@lru_cache(256)
def _members(kind: Any) -> dict[str, Any]:
    """The keys of a model or dataclass, each with its type."""
    if not isinstance(kind, type) or get_origin(kind) is not None:
        return {}
    if issubclass(kind, BaseModel):
        return {name: field.annotation for name, field in kind.model_fields.items()}
    return get_type_hints(kind) if is_dataclass(kind) else {}
