"""Request ids: a new one for every request, in `X-Request-ID` and in every line that is logged for it."""

from __future__ import annotations

import secrets
from collections.abc import Awaitable

from starlette.types import ASGIApp, Message, Receive, Scope, Send
from structlog.contextvars import bind_contextvars, get_contextvars

HEADER = "X-Request-ID"
_ENCODED = HEADER.lower().encode()


class RequestId:
    """Gives each request an id."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """Handles one connection."""
        if scope["type"] not in ("http", "websocket"):
            return self._app(scope, receive, send)
        # Never the caller's: an id that can be chosen could be anyone's, or anything.
        request_id = secrets.token_hex(8)

        def send_with_id(message: Message) -> Awaitable[None]:
            if message["type"] in ("http.response.start", "websocket.http.response.start"):
                others = [each for each in message["headers"] if each[0] != _ENCODED]
                message["headers"] = [*others, (_ENCODED, request_id.encode())]
            return send(message)

        # Not reset: a request is a task of its own, and an error is logged outside of every middleware.
        bind_contextvars(request=request_id)
        return self._app(scope, receive, send_with_id)


def request_id_header() -> dict[str, str]:
    """The header for a response that no middleware passes."""
    bound = get_contextvars().get("request")
    return {} if bound is None else {HEADER: str(bound)}
