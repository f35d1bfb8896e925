"""The route class of the API, and all that differs from route to route.

A request to an `ApiRoute` passes, in this order: access control, body limit, form (query, content type),
conditional requests (`If-Match`, `Idempotency-Key`), FastAPI's validation, the endpoint. A `GuardedRoute` has
the first two.

A route says what is special about it with `@policy(...)` on its endpoint; nothing else in the service knows
its path.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from fastapi import APIRouter, Request, Response
from fastapi.params import Path, Query
from fastapi.routing import APIRoute
from pydantic import BaseModel, ValidationError
from starlette.requests import ClientDisconnect
from starlette.types import Receive, Scope, Send

from service.http import json
from service.http.access_control import check_access, count_change
from service.http.asker import asked_by
from service.http.body_limit import read_body, receive_again
from service.http.conditional.etag import check_before_call
from service.http.conditional.handler import handle_conditionally
from service.http.content_type import check_encoding
from service.http.deps import context_in
from service.http.query_params import check_numbers, check_query
from service.http.route_policy import policy_of
from service.http.session_json import PREFIX
from service.settings import Settings

_WITHOUT_BODY = ("GET", "HEAD")
_WITH_JSON = ("POST", "PATCH")


class GuardedRoute(APIRoute):
    """A route with access control and a body limit."""

    def __init__(self, path: str, endpoint: Callable[..., Any], **options: Any) -> None:
        self.policy = policy_of(endpoint)
        super().__init__(path, endpoint, **options)

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers a request that matches the path. Raises a `ProblemError`."""
        context = context_in(scope)
        check_access(scope, context.guard, link=self.policy.link)
        count_change(scope, context.guard)
        later = receive
        if scope["method"] not in _WITHOUT_BODY:
            try:
                body = await read_body(scope, receive, self.body_limit(context.settings))
            except ClientDisconnect:
                return
            receive = receive_again(body, receive)
        timed = self.policy.timed and scope["method"] in (self.methods or ())
        with asked_by(scope, later), context.metrics.command("rest") if timed else nullcontext():
            await super().handle(scope, receive, send)

    def body_limit(self, settings: Settings) -> int:
        """How many bytes a body may have."""
        return settings.max_recording_bytes if self.policy.recording else settings.max_body_bytes


LARGE_BODY = 16_384
"""A body of more bytes, such as a recording, is read and validated in a thread."""


class _StrictRequest(Request):
    """Reads JSON without duplicate keys (`service.http.json`)."""

    async def json(self) -> Any:
        body = await self.body()
        if len(body) <= LARGE_BODY:
            return json.loads(body)
        route = self.scope.get("route")
        work = context_in(self.scope).manager.work
        return await work.in_thread(_validated, body, getattr(route, "body_type", None))


def _validated(body: bytes, model: Any) -> Any:
    """The model of a body, which FastAPI takes as it is; its values where it is not valid."""
    values = json.loads(body)
    try:
        return (
            model.model_validate(values)
            if isinstance(model, type) and issubclass(model, BaseModel)
            else values
        )
    except ValidationError:
        return values  # FastAPI says what is wrong


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
            strict = _StrictRequest(request.scope, request.receive)
            return await handle_conditionally(strict, handler, self.policy)

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
