"""Access to a route of the API: the API key, cross-site GETs, and the rate of changes.

Pages, documentation and health checks are plain routes and open to all; they tell nothing of any session.
Host and origin are checked before, for every path, by `service.http.middleware`.
"""

from __future__ import annotations

from typing import Any
from urllib.parse import parse_qs

from starlette.types import Scope

from service.http.headers import first_header
from service.http.middleware.cross_site import READING
from service.interpreter.owners import ask_as
from service.problems import CrossSite
from service.security.cross_site import is_cross_site, same_site
from service.security.guard import Guard, client_of

_GETTING = frozenset(("GET", "HEAD"))


def check_access(scope: Scope, guard: Guard, *, link: bool = False) -> None:
    """Lets a client in, as the owner that it is. Raises `CrossSite`, `Unauthorized` or `TooManyWrongKeys`.

    `link`: whether a ticket for this address will do.
    """
    if scope["method"] in _GETTING:
        _check_cross_site_get(scope)
    client = client_of(scope)
    if not (link and _has_ticket(scope, guard)):
        guard.admit(client, first_header(scope, b"authorization"))
    ask_as(client)


def _has_ticket(scope: Scope, guard: Guard) -> bool:
    """Whether a GET without a key comes with a ticket for its address."""
    if scope["method"] not in _GETTING or first_header(scope, b"authorization") is not None:
        return False
    tickets = parse_qs(scope["query_string"].decode("latin-1")).get("ticket", [])
    return len(tickets) == 1 and guard.link_tickets.admits(scope["path"], tickets[0])


def count_change(scope: Scope, guard: Guard) -> None:
    """Counts a request that may change something. Raises `RateLimited`."""
    if scope["method"] not in READING:
        guard.count_change(client_of(scope))


def _check_cross_site_get(scope: Scope) -> None:
    """Refuses GETs from another site's page: it could not read the answer, but the service would do the work.

    Non-browser clients send neither header.
    """
    if is_cross_site(first_header(scope, b"sec-fetch-site")) or not same_site(
        first_header(scope, b"origin"), first_header(scope, b"host")
    ):
        raise CrossSite("Only this service's own page may ask this, or no page at all.")


def document(method: str, guarded: bool, operation: dict[str, Any], add_problems: Any) -> None:
    """Adds access control to the documentation of a call; `guarded` is whether its route checks access."""
    slugs = ["foreign-host"]
    if guarded:
        slugs += ["key-needed", "too-many-wrong-keys"]
        operation["security"] = [{"key": []}, {}]
    if method != "get" or guarded:
        slugs.append("cross-site")
    if method != "get":
        slugs.append("too-many-changes")
    add_problems(operation, *slugs)
