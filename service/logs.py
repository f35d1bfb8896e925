"""Log lines: for people or as JSON, with the id of the request they belong to, and without secrets.

Configured by whoever runs the service, here and nowhere else: a library does not configure logs.
"""

from __future__ import annotations

import logging
import secrets
import sys
from collections.abc import Collection, MutableMapping
from typing import Any, Literal, TextIO

import structlog
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from structlog.contextvars import bind_contextvars, get_contextvars

from service.settings import Settings

HEADER = "X-Request-ID"
HIDDEN = "[hidden]"
_SECRET_NAMES = ("key", "authorization", "password", "secret", "ticket", "token")


def configure(settings: Settings, to: TextIO | None = None) -> None:
    """Write log lines as the settings say, on standard error."""
    to = sys.stderr if to is None else to
    secret = [each.get_secret_value() for each in (settings.api_key, settings.llm_api_key) if each]
    structlog.configure(
        processors=[
            structlog.contextvars.merge_contextvars,
            structlog.processors.add_log_level,
            structlog.processors.TimeStamper(fmt="iso", utc=True),
            # As text before anything is hidden: a traceback may quote what must not be written. Never with
            # the values of local names, which richer renderers print.
            structlog.processors.format_exc_info,
            _Hiding(secret),
            _renderer(settings.log_format, to),
        ],
        wrapper_class=structlog.make_filtering_bound_logger(logging.INFO),
        logger_factory=structlog.PrintLoggerFactory(to),
        cache_logger_on_first_use=True,
    )


def _renderer(form: Literal["console", "json"], to: TextIO) -> Any:
    if form == "json":
        return structlog.processors.JSONRenderer(default=str)
    return structlog.dev.ConsoleRenderer(
        colors=to.isatty(), exception_formatter=structlog.dev.plain_traceback
    )


class _Hiding:
    """Takes out what is secret, by its name and by its value, however deep."""

    def __init__(self, values: Collection[str]) -> None:
        self._values = [value for value in values if value]

    def __call__(
        self, _logger: Any, _method: str, event: MutableMapping[str, Any]
    ) -> MutableMapping[str, Any]:
        """One line."""
        for name, value in event.items():
            event[name] = self._hidden(name, value)
        return event

    def _hidden(self, name: str, value: Any) -> Any:
        if any(part in _SECRET_NAMES for part in name.lower().split("_")):
            return HIDDEN
        if isinstance(value, dict):
            return {key: self._hidden(str(key), each) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return [self._hidden("", each) for each in value]
        text = value if isinstance(value, str) else str(value)
        if not any(secret in text for secret in self._values):
            return value
        for secret in self._values:
            text = text.replace(secret, HIDDEN)
        return text


class RequestIds:
    """Gives each request an id: in its answer, and in every line that is logged on its behalf."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        # Always our own: one that the caller may choose could be anyone's, or anything.
        request_id = secrets.token_hex(8)

        async def named(message: Message) -> None:
            if message["type"] in ("http.response.start", "websocket.http.response.start"):
                MutableHeaders(scope=message)[HEADER] = request_id
            await send(message)

        # Left bound: a request is a task of its own, and an error is logged outside of every middleware.
        bind_contextvars(request=request_id)
        await self._app(scope, receive, named)


def request_header() -> dict[str, str]:
    """The header with the id of the request that is being answered, where a middleware cannot add it."""
    bound = get_contextvars().get("request")
    return {} if bound is None else {HEADER: str(bound)}
