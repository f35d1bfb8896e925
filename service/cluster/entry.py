"""The entry: an ASGI application that passes every request on to the shard that has the session.

It holds nothing but connections. Everything about a request is checked by the shard that gets it; the entry
only checks the `Host` header, which names the entry and no shard, and the size of a body that it reads.
"""

from __future__ import annotations

import asyncio
from typing import Final

from prometheus_client.exposition import CONTENT_TYPE_LATEST
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket

from service.cluster.http_forward import Answer, HttpForwarder
from service.cluster.merge import merge_health, merge_metrics, merge_sessions, read_json
from service.cluster.places import Places
from service.cluster.routing import Several, route
from service.cluster.ws_relay import relay
from service.contract.encode.json import encoded
from service.http.body_limit import read_body
from service.http.headers import first_header
from service.http.middleware.head_method import HeadMethod
from service.http.middleware.security_headers import SECURITY_HEADERS
from service.http.responses import json_response
from service.problems import MEDIA_TYPE, MisdirectedRequest, ProblemError, ShardDown
from service.security.hosts import Hosts
from service.settings import Settings

ANSWER_S: Final = 1.0
"""How long a shard may take for its part of an answer; after that it counts as down."""

_OF_ONE_ANSWER: Final = frozenset((b"if-none-match", b"if-match", b"accept-encoding"))
"""Headers that would be about one shard's part of an answer."""


class Entry:
    """Routes requests and sockets to the shards of one service."""

    def __init__(self, places: Places, token: str, settings: Settings) -> None:
        """`token`: tells the shards that a request comes from here."""
        self._places = places
        self._token = token
        self._hosts = Hosts(settings.allowed_hosts or "")
        self._most_bytes = max(settings.max_body_bytes, settings.max_recording_bytes)
        self._forwarder = HttpForwarder(token)
        self._answer_of_all = HeadMethod(self._merge)

    async def aclose(self) -> None:
        """Close the connections to the shards."""
        await self._forwarder.aclose()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handles one connection."""
        try:
            if not self._hosts.answers_to(first_header(scope, b"host"), scope):
                raise MisdirectedRequest
            if scope["type"] == "websocket":
                place = self._places[self._shard(self._route(scope, "GET"))]
                await relay(scope, receive, send, place, self._token)
                return
            target = self._route(scope, scope["method"])
            if target is Several.ALL:
                await self._answer_of_all(scope, receive, send)
            else:
                await self._forward(scope, receive, send, self._shard(target))
        except ClientDisconnect:
            pass
        except ProblemError as problem:
            await _send_problem(problem, scope, receive, send)

    def _route(self, scope: Scope, method: str) -> int | Several:
        key = first_header(scope, b"idempotency-key")
        return route(method, scope["path"], key, len(self._places))

    def _shard(self, target: int | Several) -> int:
        return self._places.any_up() if isinstance(target, Several) else target

    async def _forward(self, scope: Scope, receive: Receive, send: Send, shard: int) -> None:
        """Send a request to a shard, and to another one if that says that it has the session."""
        body = await read_body(scope, receive, self._most_bytes)
        places, forward = self._places, self._forwarder.forward
        owner = await forward(scope, receive, send, body, shard, places[shard])
        if owner is not None and owner < len(places):
            owner = await forward(scope, receive, send, body, owner, places[owner])
        if owner is not None:
            raise ShardDown

    async def _merge(self, scope: Scope, receive: Receive, send: Send) -> None:
        await (await self._merged(scope))(scope, receive, send)

    async def _merged(self, scope: Scope) -> Response:
        """The answer that is put together from those of all shards. Raises `ShardDown`."""
        fetch = self._forwarder.fetch
        found = await asyncio.gather(
            *(fetch(scope, place, ANSWER_S, _OF_ONE_ANSWER) for place in self._places)
        )
        refused = next((each for each in found if each is not None and each.status != 200), None)
        if refused is not None:
            return _as_it_came(refused)
        path = scope["path"]
        bodies = [None if each is None else each.body for each in found]
        if path == "/healthz":
            health = [None if body is None else read_json(body) for body in bodies]
            return _fresh(json_response(merge_health(health, self._places)))
        if path == "/metrics":
            texts = [None if body is None else body.decode() for body in bodies]
            return _fresh(Response(merge_metrics(texts, self._places), media_type=CONTENT_TYPE_LATEST))
        if path == "/readyz":
            if None in bodies:
                raise ShardDown
            return _fresh(json_response({"status": "ready"}))
        pages = {shard: read_json(body) for shard, body in enumerate(bodies) if body is not None}
        if not pages:
            raise ShardDown
        return _fresh(json_response(merge_sessions(pages, len(self._places))))


def _fresh(response: Response) -> Response:
    response.headers.update(SECURITY_HEADERS)
    return response


def _as_it_came(answer: Answer) -> Response:
    response = Response(answer.body, answer.status)
    response.raw_headers = list(answer.headers)
    return response


async def _send_problem(problem: ProblemError, scope: Scope, receive: Receive, send: Send) -> None:
    headers = SECURITY_HEADERS | problem.headers
    response = Response(encoded(problem.document()), problem.status, headers, MEDIA_TYPE)
    if scope["type"] == "websocket":
        await WebSocket(scope, receive, send).send_denial_response(response)
    else:
        await response(scope, receive, send)
