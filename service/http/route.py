"""The route class of the API, and all that differs from route to route.

A request to an `ApiRoute` passes, in this order: access control, body limit, form (query, content type),
conditional requests (`If-Match`, `Idempotency-Key`), FastAPI's validation, the endpoint. A `GuardedRoute` has
the first two.

A route says what is special about it with `@policy(...)` on its endpoint; nothing else in the service knows
its path.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Annotated, Any, TypeVar, get_args, get_origin, get_type_hints

from fastapi import APIRouter, Request, Response
from fastapi.params import Path, Query
from fastapi.routing import APIRoute
from starlette.requests import ClientDisconnect
from starlette.types import Receive, Scope, Send

from service.http import json
from service.http.access_control import check_access
from service.http.body_limit import read_body, receive_again
from service.http.conditional.etag import check_before_call
from service.http.conditional.handler import handle_conditionally
from service.http.content_type import check_encoding
from service.http.deps import context_in
from service.http.direct_call import DirectCall
from service.http.query_params import check_numbers, check_query
from service.http.session_json import PREFIX

_WITHOUT_BODY = ("GET", "HEAD")
_WITH_JSON = ("POST", "PATCH")

Endpoint = TypeVar("Endpoint", bound=Callable[..., Awaitable[Response]])


@dataclass(frozen=True, slots=True)
class RoutePolicy:
    """What is special about a route. The defaults are those of an ordinary call."""

    idempotency_key: bool = True
    """whether POST and PATCH heed `Idempotency-Key`; false where nothing changes"""
    entity_tag: bool = True
    """whether an answer about a session has an `ETag`"""
    recording: bool = False
    """whether the body may hold a recording, which has a larger limit"""
    timed: bool = False
    """whether it is a command, whose time is in the metrics"""
    direct: bool = False
    """whether it is called without FastAPI where possible (`service.http.direct_call`)"""


_ORDINARY = RoutePolicy()


def policy(**options: bool) -> Callable[[Endpoint], Endpoint]:
    """Decorates an endpoint with its `RoutePolicy`."""

    def decorate(endpoint: Endpoint) -> Endpoint:
        endpoint.policy = RoutePolicy(**options)  # type: ignore[attr-defined]
        return endpoint

    return decorate


class GuardedRoute(APIRoute):
    """A route with access control and a body limit."""

    def __init__(self, path: str, endpoint: Callable[..., Any], **options: Any) -> None:
        self.policy: RoutePolicy = getattr(endpoint, "policy", _ORDINARY)
        self._direct = DirectCall(endpoint) if self.policy.direct else None
        super().__init__(path, endpoint, **options)

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers a request that matches the path. Raises a `ProblemError`."""
        context = context_in(scope)
        timed = self.policy.timed and scope["method"] in self.methods
        with context.metrics.command("rest") if timed else nullcontext():
            check_access(scope, context.guard)
            body = b""
            if scope["method"] not in _WITHOUT_BODY:
                settings = context.settings
                limit = settings.max_recording_bytes if self.policy.recording else settings.max_body_bytes
                try:
                    body = await read_body(scope, receive, limit)
                except ClientDisconnect:
                    return
                receive = receive_again(body, receive)
            if self._direct is not None and scope["method"] in self.methods:
                read = self._direct.read(scope, body)
                if read is not None:
                    await self._call_directly(self._direct, read[0], scope, receive, send)
                    return
            await super().handle(scope, receive, send)

    async def _call_directly(
        self, call: DirectCall, body: Any, scope: Scope, receive: Receive, send: Send
    ) -> None:
        response = await self.handle_request(Request(scope, receive), lambda request: call(request, body))
        await response(scope, receive, send)

    async def handle_request(
        self, request: Request, handler: Callable[[Request], Awaitable[Response]]
    ) -> Response:
        """Answers a request by its handler, if its conditions hold."""
        return await handle_conditionally(
            request,
            handler,
            entity_tag=self.policy.entity_tag,
            idempotency_key=self.policy.idempotency_key,
        )


class _StrictRequest(Request):
    """Reads JSON without duplicate keys (`service.http.json`)."""

    async def json(self) -> Any:
        return json.loads(await self.body())


class ApiRoute(GuardedRoute):
    """A route of the API: checks a request's form, and handles conditional requests."""

    def __init__(self, path: str, endpoint: Callable[..., Any], **options: Any) -> None:
        self.body_type: Any = get_type_hints(endpoint).get("body")
        self._query, self._integers = _find_parameters(endpoint)
        super().__init__(path, check_before_call(endpoint), **options)

    def get_route_handler(self) -> Any:
        """FastAPI's handler, within the checks of the form and of the conditions."""
        handler = super().get_route_handler()

        async def handle(request: Request) -> Response:
            if request.scope["query_string"]:
                items = request.query_params.multi_items()
                check_query(items, self._query)
                check_numbers(items, self._integers)
            check_numbers(request.path_params.items(), self._integers)
            if request.method in _WITH_JSON:
                check_encoding(request)
            return await self.handle_request(_StrictRequest(request.scope, request.receive), handler)

        return handle


def operation_id(route: APIRoute) -> str:
    """The id of a call in the OpenAPI document: its endpoint's name."""
    return route.name


def api_router(tag: str, **options: Any) -> APIRouter:
    """A router for routes of the API. An endpoint is named as a verb and a thing: `create_session`."""
    return APIRouter(
        prefix=PREFIX,
        tags=[tag],
        route_class=ApiRoute,
        generate_unique_id_function=operation_id,
        **options,
    )


def _find_parameters(endpoint: Callable[..., Any]) -> tuple[frozenset[str], frozenset[str]]:
    """The names of an endpoint's query parameters, and of its integers in query and path."""
    query, integers = set(), set()
    for name, hint in get_type_hints(endpoint, include_extras=True).items():
        if get_origin(hint) is not Annotated:
            continue
        kind, *details = get_args(hint)
        for detail in details:
            if not isinstance(detail, Query | Path):
                continue
            alias = detail.alias or name
            if isinstance(detail, Query):
                query.add(alias)
            if kind is int or int in get_args(kind):
                integers.add(alias)
    return frozenset(query), frozenset(integers)
