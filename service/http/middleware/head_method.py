"""`HEAD`: the headers of GET, without the body, for every route.

Starlette's own routes answer HEAD and FastAPI's do not. A response without an end (an event stream) ends with
its first part.
"""

from __future__ import annotations

from collections.abc import Awaitable
from contextlib import suppress

from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send


class _EndedError(OSError):
    """Ends a streaming response: to the application, the client has disconnected (`OSError` in ASGI)."""


class HeadMethod:
    """Asks the application as GET and drops the body."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """Handles one connection."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            return self._app(scope, receive, send)
        return self._head(scope, receive, send)

    async def _head(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_head(message: Message) -> None:
            if message["type"] != "http.response.body":
                await send(message)
                return
            await send({"type": "http.response.body", "body": b""})
            if message.get("more_body", False):
                raise _EndedError

        with suppress(_EndedError, ClientDisconnect):
            await self._app({**scope, "method": "GET"}, receive, send_head)
