"""Which shard a request is for: computed from its path, or from its idempotency key, and never looked up."""

from __future__ import annotations

import re
from enum import Enum, auto
from typing import Final

from service.http.session_json import PREFIX
from service.sharding import shard_of

_OF_ONE: Final = re.compile(rf"{re.escape(PREFIX)}/(?:sessions|evaluations|answers)/([^/]+)")
"""A session, an evaluation or a long answer, and everything below it."""

_OF_ALL: Final = frozenset(("/healthz", "/readyz", "/metrics", f"{PREFIX}/sessions"))


class Several(Enum):
    """Requests that are not for one certain shard."""

    ALL = auto()
    """each answers for its part"""
    ANY = auto()
    """every shard gives the same answer"""


def route(method: str, path: str, idempotency_key: str | None, shards: int) -> int | Several:
    """The number of the shard that a request is for.

    A new session lives in the shard that creates it. Under an idempotency key that is always the same one, so
    that a repeated request finds the first while it is still under way.
    """
    found = _OF_ONE.match(path)
    if found is not None:
        return shard_of(found[1], shards)
    if method in ("GET", "HEAD") and path in _OF_ALL:
        return Several.ALL
    return Several.ANY if idempotency_key is None else shard_of(idempotency_key, shards)
