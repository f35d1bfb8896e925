"""`HEAD`: the headers of GET, without the body, for every route.

Starlette's own routes answer HEAD and FastAPI's do not. A response without an end (an event stream) is
cancelled as soon as its first part is there.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable

from starlette.types import ASGIApp, Message, Receive, Scope, Send


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
        streaming = asyncio.Event()

        async def send_head(message: Message) -> None:
            if message["type"] != "http.response.body":
                await send(message)
            elif message.get("more_body", False):
                streaming.set()
            elif not streaming.is_set():
                await send({"type": "http.response.body", "body": b""})

        answering = asyncio.ensure_future(self._app({**scope, "method": "GET"}, receive, send_head))
        waiting = asyncio.ensure_future(streaming.wait())
        try:
            await asyncio.wait((answering, waiting), return_when=asyncio.FIRST_COMPLETED)
        finally:
            waiting.cancel()
            if not answering.done():
                answering.cancel()
                await asyncio.wait((answering,))
        if streaming.is_set():
            await send({"type": "http.response.body", "body": b""})
        else:
            await answering
