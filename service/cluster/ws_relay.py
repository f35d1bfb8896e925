"""Relays a WebSocket between a client and the shard that has its session."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import Final

from starlette.types import Message, Receive, Scope, Send
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus

from service.cluster.forwarded import HEADER, forwarded_header
from service.cluster.http_forward import CONNECT_S
from service.cluster.places import Place
from service.http.realtime.direct_write import direct_write_of

TRY_AGAIN: Final = 1013
"""The close code while a shard is being replaced."""
RESTART: Final = 1012
"""The close code when a shard has died: the client connects again."""

_MOST_WAITING: Final = 16
"""Messages of a shard that wait for a slow client; beyond that the shard waits, and skips ticks for it."""

_OWN: Final = frozenset((b"host", b"connection", b"upgrade", HEADER))
_UNSENDABLE: Final = frozenset((1005, 1006, 1015))
"""Codes that tell of a close and are never sent in one (RFC 6455, 7.4.1)."""


async def relay(scope: Scope, receive: Receive, send: Send, place: Place | None, token: str) -> None:
    """Both directions until either side ends it."""
    await receive()  # that it wants to connect
    if place is None:
        await _close_unopened(send)
        return
    target = scope["raw_path"].decode("latin-1")
    if scope["query_string"]:
        target += "?" + scope["query_string"].decode("latin-1")
    try:
        upstream = await connect(
            f"ws://{place.address}{target}",
            additional_headers=_headers(scope, token),
            user_agent_header=None,
            compression=None,
            max_size=None,
            max_queue=_MOST_WAITING,
            ping_interval=None,
            open_timeout=CONNECT_S,
            close_timeout=CONNECT_S,
            proxy=None,
        )
    except InvalidStatus as refused:
        await _refuse(scope, send, refused)
        return
    except (OSError, TimeoutError, InvalidHandshake):
        await _close_unopened(send)
        return
    await send({"type": "websocket.accept"})
    await _both_ways(scope, receive, send, upstream)


def _headers(scope: Scope, token: str) -> list[tuple[str, str]]:
    name, value = forwarded_header(scope, token)
    kept = [
        (each.decode("latin-1"), said.decode("latin-1"))
        for each, said in scope["headers"]
        if each not in _OWN and not each.startswith(b"sec-websocket-")
    ]
    return [*kept, (name.decode(), value.decode("latin-1"))]


async def _both_ways(scope: Scope, receive: Receive, send: Send, upstream: ClientConnection) -> None:
    down = asyncio.create_task(_to_client(scope, send, upstream))
    up = asyncio.create_task(_to_shard(receive, upstream))
    await asyncio.wait((down, up), return_when=asyncio.FIRST_COMPLETED)
    for task in (down, up):
        task.cancel()
    await asyncio.wait((down, up))
    await upstream.close()


async def _to_shard(receive: Receive, upstream: ClientConnection) -> None:
    """Pass on what the client sends, until it goes."""
    while True:
        received = await receive()
        if received["type"] == "websocket.disconnect":
            code = received.get("code") or 1000
            await upstream.close(1000 if code in _UNSENDABLE else code)
            return
        text = received.get("text")
        try:
            await upstream.send(received["bytes"] if text is None else text)
        except ConnectionClosed:
            return


async def _to_client(scope: Scope, send: Send, upstream: ClientConnection) -> None:
    """Pass on what the shard sends, and its close."""
    write = direct_write_of(scope)
    try:
        while True:
            message = await upstream.recv()
            if isinstance(message, bytes):
                await send({"type": "websocket.send", "bytes": message})
            elif write is None or not write(message.encode()):
                await send({"type": "websocket.send", "text": message})
    except ConnectionClosed as closed:
        told = closed.rcvd
        code, reason = (RESTART, "") if told is None else (told.code, told.reason)
        await _send_close(send, RESTART if code in _UNSENDABLE else code, reason)
    except (RuntimeError, OSError):
        return  # the client has gone


async def _send_close(send: Send, code: int, reason: str = "") -> None:
    message: Message = {"type": "websocket.close", "code": code, "reason": reason}
    with suppress(RuntimeError, OSError):  # the client has gone first
        await send(message)


async def _close_unopened(send: Send) -> None:
    """Accept and close: a page cannot read the status of a handshake that was refused."""
    await send({"type": "websocket.accept"})
    await _send_close(send, TRY_AGAIN, "the process of this session is being replaced")


async def _refuse(scope: Scope, send: Send, refused: InvalidStatus) -> None:
    """Answer the handshake as the shard did."""
    response = refused.response
    if "websocket.http.response" not in (scope.get("extensions") or {}):
        await send({"type": "websocket.close", "code": 1008})
        return
    headers = [
        (name.lower().encode("latin-1"), value.encode("latin-1"))
        for name, value in response.headers.raw_items()
        if name.lower() not in ("connection", "date", "server")
    ]
    await send({"type": "websocket.http.response.start", "status": response.status_code, "headers": headers})
    await send({"type": "websocket.http.response.body", "body": bytes(response.body or b"")})
