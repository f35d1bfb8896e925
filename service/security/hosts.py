"""Host names the service answers to (DNS rebinding).

A page of `evil.example` can have its own name resolve to this machine; the browser then takes the service for
that site. Only `Host` shows it. Accepted are loopback names, the address the connection came in at, and the
names in the settings.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from functools import lru_cache
from typing import Any
from urllib.parse import urlsplit

_MAX_CACHED_CHARS = 255
"""Longer names are not cached."""

_LOOPBACK = frozenset(("localhost", "127.0.0.1", "::1"))


def is_loopback(host: str) -> bool:
    """Whether an address to listen on can be reached from this machine only."""
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


class Hosts:
    """The names of one service."""

    def __init__(self, names: str) -> None:
        """`names` are further names, separated by commas."""
        self._names = _LOOPBACK | {each.strip().lower() for each in names.split(",") if each.strip()}

    def answers_to(self, host: str | None, scope: Mapping[str, Any]) -> bool:
        """Whether a `Host` header, if there is one, names this service."""
        if host is None:
            return True
        name = _cached_name(host) if len(host) <= _MAX_CACHED_CHARS else _name(host)
        server = scope.get("server")
        return name in self._names or (server is not None and name == str(server[0]).lower())


def _name(host: str) -> str | None:
    """A `Host` without its port; None if it is malformed."""
    try:
        parts = urlsplit(f"//{host}")
        parts.port  # noqa: B018 - raises where it is no number
    except ValueError:
        return None
    return None if parts.path or parts.query or parts.fragment or "@" in host else parts.hostname


_cached_name = lru_cache(64)(_name)
