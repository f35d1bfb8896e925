"""Tickets: good for one socket and a few seconds, so that a page need not hand its key to every socket.

One process keeps them in memory. Several sign them, since the one that issues a ticket need not be the one
whose session is watched.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets
import time
from collections.abc import Callable

from pydantic import SecretStr

GOOD_FOR_S = 30
_SIGNATURE_CHARS = 40
MOST = 10_000
"""Tickets that may be out at once; the oldest goes first."""


class Tickets:
    """The tickets that are out; kept in memory, since none outlives half a minute."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._until: dict[str, float] = {}

    def issue(self) -> str:
        """A new ticket."""
        self._forget()
        while len(self._until) >= MOST:
            del self._until[next(iter(self._until))]
        ticket = secrets.token_urlsafe(32)
        self._until[ticket] = self._now() + GOOD_FOR_S
        return ticket

    def take(self, ticket: str) -> bool:
        """Whether it is good; from now on it is not."""
        return self._until.pop(ticket, 0.0) > self._now()

    def _forget(self) -> None:
        """All are good for the same time, so the first in are the first to go."""
        now = self._now()
        while self._until and self._until[first := next(iter(self._until))] <= now:
            del self._until[first]


class SignedTickets(Tickets):
    """Tickets that every shard of a service knows by their signature; each takes one only once."""

    def __init__(
        self,
        secret: SecretStr | None,
        now: Callable[[], float] = time.monotonic,
        wall: Callable[[], float] = time.time,
    ) -> None:
        """`secret`: the service's key, with which they end. `wall`: seconds since 1970."""
        super().__init__(now)
        value = "" if secret is None else secret.get_secret_value()
        self._secret = hashlib.sha256(f"socket ticket {value}".encode()).digest()
        self._wall = wall

    def issue(self) -> str:
        """A new ticket."""
        said = f"{int(self._wall()) + GOOD_FOR_S}-{secrets.token_hex(12)}"
        return f"{said}-{self._signature(said)}"

    def take(self, ticket: str) -> bool:
        """Whether it is good; from now on it is not, here."""
        said, _, signature = ticket.rpartition("-")
        until = said.partition("-")[0]
        if not hmac.compare_digest(signature.encode("utf-8", "replace"), self._signature(said).encode()):
            return False
        left_s = int(until) - self._wall()
        self._forget()
        if not left_s > 0 or said in self._until or len(self._until) >= MOST:
            return False
        self._until[said] = self._now() + GOOD_FOR_S
        return True

    def _signature(self, said: str) -> str:
        signed = hmac.new(self._secret, said.encode("utf-8", "replace"), hashlib.sha256)
        return signed.hexdigest()[:_SIGNATURE_CHARS]
