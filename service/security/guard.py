"""All that guards one service, made from its settings."""

from __future__ import annotations

from typing import Any

from service.problems import RateLimited
from service.security.api_key import Key
from service.security.hosts import Hosts, is_loopback
from service.security.quotas import Quotas
from service.security.rate_limit import RateLimiter
from service.security.ws_tickets import Tickets
from service.settings import Settings

STRANGERS_PER_MINUTE = 600
"""Changing calls of one client in a minute where the service has a key and nothing else was said."""


class Guard:
    """Key, tickets, hosts, buckets and quotas."""

    def __init__(self, settings: Settings) -> None:
        self.key = Key(settings.api_key)
        self.tickets = Tickets()
        self.hosts = Hosts(settings.allowed_hosts or "")
        per_minute = settings.changes_per_minute
        if per_minute is None and self.key.required:
            per_minute = STRANGERS_PER_MINUTE
        self.rate_limiter = RateLimiter(per_minute)
        self.quotas = Quotas(settings.max_client_sessions, settings.max_client_cells)

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
    if is_loopback(settings.host) or Key(settings.api_key).required:
        return None
    return (
        f"{settings.host} can be reached from other machines, so a key is needed: set ROADTALK_API_KEY, "
        "or listen on 127.0.0.1."
    )
