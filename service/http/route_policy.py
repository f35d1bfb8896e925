"""What is special about a route, said by a decorator on its endpoint."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import TypeVar

from starlette.responses import Response

Endpoint = TypeVar("Endpoint", bound=Callable[..., Awaitable[Response]])


@dataclass(frozen=True, slots=True)
class RoutePolicy:
    """The defaults are those of an ordinary call."""

    idempotency_key: bool = True
    """whether POST and PATCH heed `Idempotency-Key`; false where nothing changes"""
    entity_tag: bool = True
    """whether an answer about a session has an `ETag`"""
    recording: bool = False
    """whether the body may hold a recording, which has a larger limit"""
    timed: bool = False
    """whether it is a command, whose time is in the metrics"""
    link: bool = False
    """whether a ticket in the query opens it where the service has a key (`service.security.link_tickets`)"""
    direct: bool = False
    """whether `service.http.middleware.direct_routes` answers it where possible"""


def policy(**options: bool) -> Callable[[Endpoint], Endpoint]:
    """Decorates an endpoint with its `RoutePolicy`."""

    def decorate(endpoint: Endpoint) -> Endpoint:
        endpoint.policy = RoutePolicy(**options)  # type: ignore[attr-defined]
        return endpoint

    return decorate


def policy_of(endpoint: Callable[..., object]) -> RoutePolicy:
    """The policy of an endpoint."""
    found: RoutePolicy = getattr(endpoint, "policy", _ORDINARY)
    return found


_ORDINARY = RoutePolicy()
