"""Responses made straight from JSON values: the models in `service.contract` document, they do not encode.

A state of 26 things takes FastAPI's own encoder 254 µs and orjson 1.5 µs (`python -m bench.rest`, state).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from starlette.responses import Response
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket

from service.contract.encode.json import encoded
from service.problems import MEDIA_TYPE, ProblemError


class ProblemResponse(Response):
    """A problem document (RFC 9457); counts itself in the metrics of the application that sends it."""

    media_type = MEDIA_TYPE

    def __init__(self, problem: ProblemError) -> None:
        super().__init__(encoded(problem.document()), problem.status, problem.headers)
        self._slug = problem.slug

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Counts and sends the problem."""
        if scope["type"] == "http":
            scope["app"].state.context.metrics.count_refusal(self._slug)
        await super().__call__(scope, receive, send)


def json_response(value: Any, status: int = 200, headers: Mapping[str, str] | None = None) -> Response:
    """A response of JSON values."""
    return Response(encoded(value), status, headers, "application/json")


async def send_problem(problem: ProblemError, scope: Scope, receive: Receive, send: Send) -> None:
    """Answers a request, or refuses the handshake of a WebSocket, with a problem."""
    response = ProblemResponse(problem)
    if scope["type"] == "websocket":
        await WebSocket(scope, receive, send).send_denial_response(response)
    else:
        await response(scope, receive, send)


def etag(sequence: int) -> dict[str, str]:
    """The header that names a session's version: how many changes it has accepted."""
    return {"ETag": f'"{sequence}"'}
