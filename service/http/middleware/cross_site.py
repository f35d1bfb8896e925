"""Cross-site requests (CSRF): pages of other sites change nothing and open no WebSocket.

The service sends no CORS headers, so such a page could not read an answer; its request would be done all the
same. Costly GETs are refused in `service.http.access_control`, since that depends on the route.
"""

from __future__ import annotations

from collections.abc import Awaitable

from starlette.types import ASGIApp, Receive, Scope, Send

from service.http.headers import first_header
from service.http.responses import send_problem
from service.problems import CrossSite
from service.security.cross_site import same_site

READING = frozenset(("GET", "HEAD", "OPTIONS"))
"""Methods that change nothing."""


class CrossSiteCheck:
    """Refuses changes and WebSockets of a foreign origin."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """Handles one connection."""
        kind = scope["type"]
        changing = kind == "websocket" or (kind == "http" and scope["method"] not in READING)
        if changing and not same_site(first_header(scope, b"origin"), first_header(scope, b"host")):
            detail = "Only this service's own page may do this, or no page at all. Nothing was done."
            return send_problem(CrossSite(detail), scope, receive, send)
        return self._app(scope, receive, send)
