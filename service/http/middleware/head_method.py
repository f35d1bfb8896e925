"""`HEAD`: whatever GET answers, without the body.

In one place around all calls, so that none can be forgotten and nothing further in knows of it. An answer
that has no end is left as soon as it begins.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable

from starlette.types import ASGIApp, Message, Receive, Scope, Send


class Bodiless:
    """Asks as GET, and keeps the body back."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            return self._app(scope, receive, send)
        return self._head(scope, receive, send)

    async def _head(self, scope: Scope, receive: Receive, send: Send) -> None:
        goes_on = asyncio.Event()

        async def head(message: Message) -> None:
            if message["type"] != "http.response.body":
                await send(message)
            elif message.get("more_body", False):
                goes_on.set()
            elif not goes_on.is_set():
                await send({"type": "http.response.body", "body": b""})

        answering = asyncio.ensure_future(self._app({**scope, "method": "GET"}, receive, head))
        seen = asyncio.ensure_future(goes_on.wait())
        try:
            await asyncio.wait((answering, seen), return_when=asyncio.FIRST_COMPLETED)
        finally:
            seen.cancel()
            if not answering.done():
                answering.cancel()
                await asyncio.wait((answering,))
        if goes_on.is_set():
            await send({"type": "http.response.body", "body": b""})
        else:
            await answering
