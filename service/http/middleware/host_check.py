"""`Host` check: refuses requests under foreign names (DNS rebinding), WebSockets included.

Starlette's `TrustedHostMiddleware` answers in plain text and does not know the address a connection came in
at.
"""

from __future__ import annotations

from collections.abc import Awaitable

from starlette.types import ASGIApp, Receive, Scope, Send

from service.http.headers import first_header
from service.http.responses import send_problem
from service.problems import MisdirectedRequest
from service.security.hosts import Hosts


class HostCheck:
    """Refuses what is not asked of this service."""

    def __init__(self, app: ASGIApp, hosts: Hosts) -> None:
        self._app = app
        self._hosts = hosts

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """Handles one connection."""
        if scope["type"] in ("http", "websocket") and not self._hosts.answers_to(
            first_header(scope, b"host"), scope
        ):
            return send_problem(MisdirectedRequest(), scope, receive, send)
        return self._app(scope, receive, send)
