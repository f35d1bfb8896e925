"""What the entry tells a shard about a connection, in one header, and the check that it was the entry.

A shard listens on a port of its own, where a page of another site or another machine could reach it past the
entry. It answers only to a token that is drawn when the service starts. Who asks, and at which address, is
put back into the ASGI scope, so that the service behind sees what it would see without an entry.
"""

from __future__ import annotations

import hmac
from typing import Any, Final

from starlette.types import ASGIApp, Receive, Scope, Send

HEADER: Final = b"roadtalk-forwarded"
_NOBODY: Final = "-"
_FIELDS: Final = 7


def forwarded_header(scope: Scope, token: str) -> tuple[bytes, bytes]:
    """The header for a connection that came in at the entry."""
    parts = [token, scope["scheme"], *_address(scope.get("client")), *_address(scope.get("server"))]
    host = next((value for name, value in scope["headers"] if name == b"host"), b"")
    return HEADER, " ".join(map(str, parts)).encode() + b" " + host


def _address(address: Any) -> tuple[str, int]:
    host, port = address or (_NOBODY, 0)
    return str(host), int(port or 0)


class ForwardedOnly:
    """Refuses what the entry did not send, and gives the rest the scope that it had there."""

    def __init__(self, app: ASGIApp, token: str) -> None:
        self._app = app
        self._token = token.encode()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handles one connection."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        found = next((value for name, value in scope["headers"] if name == HEADER), b"")
        fields = found.split(b" ", _FIELDS - 1)
        if len(fields) < _FIELDS or not hmac.compare_digest(fields[0], self._token):
            await _refuse(scope, send)
            return
        _restore(scope, fields[1:])
        await self._app(scope, receive, send)


def _restore(scope: Scope, fields: list[bytes]) -> None:
    scheme, client, client_port, server, server_port, host = (each.decode("latin-1") for each in fields)
    scope["scheme"] = scheme
    scope["client"] = None if client == _NOBODY else (client, int(client_port))
    scope["server"] = None if server == _NOBODY else (server, int(server_port) or None)
    kept = [each for each in scope["headers"] if each[0] not in (HEADER, b"host")]
    scope["headers"] = [(b"host", host.encode("latin-1")), *kept] if host else kept


async def _refuse(scope: Scope, send: Send) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    await send({"type": "http.response.start", "status": 403, "headers": [(b"content-type", b"text/plain")]})
    await send({"type": "http.response.body", "body": b"Ask at the address of the service.\n"})
