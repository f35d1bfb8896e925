"""Names that are not known, and what may have been meant: keys of bodies and messages, words, parameters.

pydantic says which key it did not want and not which it would have taken; that is looked up in the type that
was wanted, where the key stands. (Its JSON schema knows as well, and takes 40 ms to make.)
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import is_dataclass
from difflib import get_close_matches
from functools import lru_cache
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel

MOST_CHARS = 60
"""Longer names are no slips."""

_TAGS = ("do", "type")
"""Keys by which the members of a union are told apart."""
_QUOTED = re.compile(r"'([^']*)'")


def near(said: str, known: Iterable[str]) -> str | None:
    """The known name that is nearest to what was said, if any is near."""
    if len(said) > MOST_CHARS:
        return None
    by_small = {name.lower(): name for name in known}
    found = get_close_matches(said.lower(), by_small, n=1)
    return by_small[found[0]] if found else None


def meant(said: Any, known: Iterable[str]) -> str:
    """The end of a sentence that says what may have been meant; nothing where that is not known."""
    found = near(said, known) if isinstance(said, str) else None
    return f"; did you mean {found}" if found else ""


def meant_of(said: Any, listed: str) -> str:
    """The same, of words that are listed in quotation marks."""
    return meant(said, _QUOTED.findall(listed))


def keys(kind: Any, sent: Any, path: Sequence[str | int]) -> Collection[str]:
    """The keys that what was `sent`, which is to be of a type, may have at a place in it."""
    kinds = list(_alternatives(kind, sent))
    for part in path:
        sent = sent[part]
        inner = [get_args(each)[:1] if isinstance(part, int) else _member(each, part) for each in kinds]
        kinds = [each for found in inner for one in found for each in _alternatives(one, sent)]
    return {name for each in kinds for name in _members(each)}


def _alternatives(kind: Any, sent: Any) -> Iterator[Any]:
    """A type, or those of a union that may be meant."""
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
