"""Forwards HTTP requests to shards, and passes their responses on as they come."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import httpcore
from starlette.types import Receive, Scope, Send

from service.cluster.forwarded import HEADER, forwarded_header
from service.cluster.places import Place
from service.http.asker import client_gone
from service.problems import OWNER_HEADER, Malformed, ShardDown

SHARD_HEADER: Final = b"roadtalk-shard"
"""In every response: the number of the shard that answered."""

CONNECT_S: Final = 2.0
IDLE_S: Final = 2.0
"""How long an idle connection to a shard is kept; less than the shard keeps it (5 s)."""

_IDLE_CONNECTIONS: Final = 256
_HOP_BY_HOP: Final = frozenset(
    (
        *(b"connection", b"keep-alive", b"proxy-authenticate", b"proxy-authorization", b"proxy-connection"),
        *(b"te", b"trailer", b"transfer-encoding", b"upgrade", b"expect"),
    )
)
_OWN: Final = frozenset((b"host", b"content-length", HEADER))

Headers = Sequence[tuple[bytes, bytes]]


@dataclass(frozen=True, slots=True)
class Answer:
    """A whole response of a shard."""

    status: int
    headers: Headers
    body: bytes


class HttpForwarder:
    """Sends requests over connections that are kept for the next ones."""

    def __init__(self, token: str) -> None:
        self._token = token
        self._pool = httpcore.AsyncConnectionPool(
            max_connections=None,
            max_keepalive_connections=_IDLE_CONNECTIONS,
            keepalive_expiry=IDLE_S,
        )

    async def aclose(self) -> None:
        """Close all connections."""
        await self._pool.aclose()

    async def fetch(
        self, scope: Scope, place: Place | None, within_s: float, left_out: frozenset[bytes] = frozenset()
    ) -> Answer | None:
        """The whole response to a request without a body, as GET; None where it does not come in time."""
        headers = [each for each in scope["headers"] if each[0] not in left_out]
        try:
            async with asyncio.timeout(within_s):
                response = await self._ask({**scope, "method": "GET", "headers": headers}, place, b"")
                try:
                    body = await response.aread()
                finally:
                    await response.aclose()
        except (TimeoutError, ShardDown, Malformed, httpcore.NetworkError, httpcore.ProtocolError):
            return None
        return Answer(response.status, _end_to_end(response.headers), body)

    async def forward(
        self, scope: Scope, receive: Receive, send: Send, body: bytes, shard: int, place: Place | None
    ) -> int | None:
        """Pass a request on and its response back; the shard to ask instead where this one names another.

        Ends the request when the client hangs up. Raises `ShardDown` or `Malformed`.
        """
        exchange = asyncio.ensure_future(self._exchange(scope, send, body, shard, place))
        gone = asyncio.ensure_future(client_gone(scope, receive))
        try:
            await asyncio.wait((exchange, gone), return_when=asyncio.FIRST_COMPLETED)
        finally:
            gone.cancel()
            if not exchange.done():
                exchange.cancel()
                await asyncio.wait((exchange,))
        return None if exchange.cancelled() else exchange.result()

    async def _exchange(
        self, scope: Scope, send: Send, body: bytes, shard: int, place: Place | None
    ) -> int | None:
        response = await self._ask(scope, place, body)
        try:
            if response.status == 421:
                owner = _owner(response.headers)
                if owner is not None:
                    return owner
            headers = [*_end_to_end(response.headers), (SHARD_HEADER, str(shard).encode())]
            await send({"type": "http.response.start", "status": response.status, "headers": headers})
            try:
                async for part in response.aiter_stream():
                    await send({"type": "http.response.body", "body": part, "more_body": True})
            except (httpcore.NetworkError, httpcore.ProtocolError):
                return None  # an answer without its end: the server closes the connection
            await send({"type": "http.response.body", "body": b""})
            return None
        finally:
            await response.aclose()

    async def _ask(self, scope: Scope, place: Place | None, body: bytes) -> httpcore.Response:
        """The response, of which nothing is read yet. Raises `ShardDown` or `Malformed`."""
        if place is None:
            raise ShardDown
        target = scope["raw_path"] + (b"?" + scope["query_string"] if scope["query_string"] else b"")
        host = f"[{place.host}]" if ":" in place.host else place.host
        url = httpcore.URL(scheme=b"http", host=host.encode(), port=place.port, target=target)
        headers = [each for each in _end_to_end(scope["headers"]) if each[0] not in _OWN]
        headers += [(b"host", place.address.encode()), forwarded_header(scope, self._token)]
        if body or any(name in (b"content-length", b"transfer-encoding") for name, _ in scope["headers"]):
            headers.append((b"content-length", str(len(body)).encode()))
        request = httpcore.Request(
            scope["method"],
            url,
            headers=headers,
            content=body,
            extensions={"timeout": {"connect": CONNECT_S}},
        )
        try:
            return await self._pool.handle_async_request(request)
        except httpcore.LocalProtocolError as error:
            raise Malformed("A header of the request cannot be read.") from error
        except (httpcore.NetworkError, httpcore.TimeoutException, httpcore.RemoteProtocolError) as error:
            raise ShardDown from error


def _end_to_end(headers: Headers) -> list[tuple[bytes, bytes]]:
    """The headers that are not about one connection alone."""
    return [(name.lower(), value) for name, value in headers if name.lower() not in _HOP_BY_HOP]


def _owner(headers: Headers) -> int | None:
    named = OWNER_HEADER.lower().encode()
    return next((int(value) for name, value in headers if name.lower() == named), None)
