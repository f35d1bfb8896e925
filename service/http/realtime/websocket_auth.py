"""Authentication of a WebSocket: the API key in its headers, or the key or a ticket in its first message.

Pages cannot set the headers of a WebSocket, and a key in its URL would be logged.
"""

from __future__ import annotations

import asyncio
from json import JSONDecodeError

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from service.contract.stream_requests import Auth
from service.http import json
from service.http.deps import context_of
from service.problems import TooManyWrongKeys, Unauthorized
from service.security.guard import client_of

AUTH_WAIT_S = 5
"""How long a WebSocket may wait with its first message."""

REFUSED = 4401
"""The close code for a WebSocket without a key or a good ticket."""


async def authenticate(socket: WebSocket) -> bool:
    """Whether an accepted WebSocket may go on; if not, it is closed. Reads its first message if need be."""
    try:
        if await _is_authentic(socket):
            return True
    except WebSocketDisconnect:
        return False
    except TooManyWrongKeys as problem:
        await socket.close(REFUSED, problem.title.lower())
        return False
    await socket.close(REFUSED, "a key or a ticket is needed")
    return False


async def _is_authentic(socket: WebSocket) -> bool:
    """Raises `TooManyWrongKeys` or `WebSocketDisconnect`."""
    guard, client = context_of(socket).guard, client_of(socket.scope)
    header = socket.headers.get("authorization")
    try:
        guard.admit(client, header)
    except Unauthorized:
        pass
    else:
        return True
    if header is None:
        try:
            received = await asyncio.wait_for(socket.receive(), AUTH_WAIT_S)
        except TimeoutError:
            received = {"type": "websocket.receive", "text": None}
        if received["type"] == "websocket.disconnect":
            raise WebSocketDisconnect
        try:
            auth = Auth.model_validate(json.loads(received.get("text") or ""))
        except (JSONDecodeError, ValidationError):
            auth = Auth(type="auth")
        if auth.ticket is not None and guard.tickets.take(auth.ticket):
            return True
        if auth.key is not None and guard.matches(client, auth.key):
            return True
    return False
