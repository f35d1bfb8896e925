"""All that guards one service, made from its settings."""

from __future__ import annotations

from typing import Any

from service.problems import RateLimited, TooManyWrongKeys, Unauthorized
from service.security.api_key import Key
from service.security.hosts import Hosts, is_loopback
from service.security.link_tickets import LinkTickets
from service.security.quotas import Quotas
from service.security.rate_limit import RateLimiter
from service.security.ws_tickets import SignedTickets, Tickets
from service.settings import Settings

STRANGERS_PER_MINUTE = 600
"""Changing calls of one client in a minute where the service has a key and nothing else was said."""
WRONG_KEYS_PER_MINUTE = 30
"""Rate limit of wrong keys per client; beyond it, not even the right key is read for a while."""
KEY_CHARS = 16
"""Characters that a key has at least where other machines can reach the service."""


class Guard:
    """Key, tickets, hosts, buckets and quotas."""

    def __init__(self, settings: Settings) -> None:
        self.key = Key(settings.api_key)
        self.tickets = Tickets() if settings.workers == 1 else SignedTickets(settings.api_key)
        self.link_tickets = LinkTickets(settings.api_key)
        self.hosts = Hosts(settings.allowed_hosts or "")
        per_minute = settings.changes_per_minute
        if per_minute is None and self.key.required:
            per_minute = STRANGERS_PER_MINUTE
        self.rate_limiter = RateLimiter(per_minute)
        self.quotas = Quotas(settings.max_client_sessions, settings.max_client_cells)
        self._wrong_keys = RateLimiter(WRONG_KEYS_PER_MINUTE)

    def admit(self, client: str, authorization: str | None) -> None:
        """Check the header of a request. Raises `Unauthorized` or `TooManyWrongKeys`."""
        self._check_tries(client)
        if self.key.admits(authorization):
            return
        if authorization is not None:
            self._wrong_keys.take(client)
        raise Unauthorized

    def matches(self, client: str, key: str) -> bool:
        """Whether a value is the key; a wrong one is counted. Raises `TooManyWrongKeys`."""
        self._check_tries(client)
        if self.key.matches(key):
            return True
        self._wrong_keys.take(client)
        return False

    def _check_tries(self, client: str) -> None:
        wait_s = self._wrong_keys.wait_s(client)
        if wait_s:
            raise TooManyWrongKeys(wait_s)

    def count_change(self, client: str) -> None:
        """One more change of a client. Raises `RateLimited`."""
        wait = self.rate_limiter.take(client)
        if wait:
            raise RateLimited(wait)


def client_of(scope: Any) -> str:
    """Who asks: the address. One key is shared by all who have it, so it tells nobody apart."""
    client = scope.get("client")
    return "" if client is None else str(client[0])


def exposure_problem(settings: Settings) -> str | None:
    """Why the service must not start like this: strangers could reach it, and no key is set."""
    if is_loopback(settings.host):
        return None
    secret = settings.api_key.get_secret_value() if settings.api_key else ""
    if len(secret) >= KEY_CHARS:
        return None
    if secret:
        return (
            f"{settings.host} can be reached from other machines, so ROADTALK_API_KEY needs at least "
            f"{KEY_CHARS} characters; `openssl rand -hex 24` makes one."
        )
    return (
        f"{settings.host} can be reached from other machines, so a key is needed: set ROADTALK_API_KEY, "
        "or listen on 127.0.0.1."
    )
