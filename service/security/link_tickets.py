"""Tickets for one address and some hours, so that a browser can open a link of a service that has a key.

A ticket is a signature of the address and of the time at which it ends, made with the key. It opens nothing
else, says nothing of the key, and ends with it.
"""

from __future__ import annotations

import hashlib
import hmac
import time
from collections.abc import Callable

from pydantic import SecretStr

GOOD_FOR_S = 24 * 3600


class LinkTickets:
    """Signs the addresses of one service."""

    def __init__(self, secret: SecretStr | None, now: Callable[[], float] = time.time) -> None:
        """`secret`: the service's key; without one no ticket is needed. `now`: seconds since 1970."""
        value = "" if secret is None else secret.get_secret_value()
        self._secret = hashlib.sha256(f"link ticket {value}".encode()).digest() if value else None
        self._now = now

    def add_to(self, path: str) -> str:
        """The path with a ticket; as it is where none is needed."""
        if self._secret is None:
            return path
        until = int(self._now()) + GOOD_FOR_S
        return f"{path}?ticket={until}-{self._signature(path, until)}"

    def admits(self, path: str, ticket: str) -> bool:
        """Whether a ticket opens a path now."""
        until, _, signature = ticket.partition("-")
        if self._secret is None or not until.isdecimal() or len(until) > 12 or int(until) <= self._now():
            return False
        return hmac.compare_digest(signature.encode(), self._signature(path, int(until)).encode())

    def _signature(self, path: str, until: int) -> str:
        assert self._secret is not None
        return hmac.new(self._secret, f"{until} {path}".encode(), hashlib.sha256).hexdigest()
