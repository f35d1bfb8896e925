"""Under which names the service is asked: a page whose name was turned to this machine is not let in.

DNS rebinding: a page of `evil.example` has its own name point here, and the browser takes the service for
that site. Only `Host` shows it. Taken are loopback names, the address the connection came in at, and the
names that the settings give.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from functools import lru_cache
from typing import Any
from urllib.parse import urlsplit

_LONGEST = 255
"""Letters of a name that is remembered: it is asked under the same few again and again."""

_OWN_MARKS = frozenset(("same-origin", "none"))
"""What browsers mark requests with that this service's own page makes, or a person by typing."""

_LOOPBACK = frozenset(("localhost", "127.0.0.1", "::1"))


def loopback(host: str) -> bool:
    """Whether an address to listen on can be reached from this machine only."""
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


class Hosts:
    """The names a service answers to."""

    def __init__(self, named: str) -> None:
        """`named` are further names, separated by commas."""
        self._named = _LOOPBACK | {each.strip().lower() for each in named.split(",") if each.strip()}

    def answers_to(self, host: str | None, scope: Mapping[str, Any]) -> bool:
        """Whether a `Host` header, if there is one, names this service."""
        if host is None:
            return True
        name = _remembered(host) if len(host) <= _LONGEST else _name(host)
        came_in_at = scope.get("server")
        return name in self._named or (came_in_at is not None and name == str(came_in_at[0]).lower())


def same_site(origin: str | None, host: str | None) -> bool:
    """Whether a browser's page, if it is one that asks, comes from here."""
    if origin is None:
        return True
    try:
        return urlsplit(origin).netloc.lower() == (host or "").lower() != ""
    except ValueError:
        return False


def marked_foreign(fetch_site: str | None) -> bool:
    """Whether a browser marks a request as begun by a page of another site (`Sec-Fetch-Site`).

    Browsers alone send that header, and no page can set it. What a person types has the mark `none`. Another
    port of this machine is `same-site`, and another site all the same.
    """
    return fetch_site is not None and fetch_site.strip().lower() not in _OWN_MARKS


def _name(host: str) -> str | None:
    """A `Host` without its port; None where it is none."""
    try:
        parts = urlsplit(f"//{host}")
        parts.port  # noqa: B018 - raises where it is no number
    except ValueError:
        return None
    return None if parts.path or parts.query or parts.fragment or "@" in host else parts.hostname


_remembered = lru_cache(64)(_name)
