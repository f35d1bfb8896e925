"""Conditional requests around the handler of every route: entity tags and idempotency keys."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from fastapi import Request, Response

from service.http.conditional import etag
from service.http.conditional.idempotency import handle_once
from service.http.deps import context_of
from service.http.route_policy import RoutePolicy

Handler = Callable[[Request], Awaitable[Response]]


async def handle_conditionally(request: Request, handler: Handler, policy: RoutePolicy) -> Response:
    """Answers a request by its handler, if its conditions hold. Raises a `ProblemError`."""
    session_id = request.path_params.get("session_id")
    if request.method == "GET":
        etag.set_check(None)
        response = await handler(request)
        if session_id is None or not policy.entity_tag or response.status_code != 200:
            return response
        session = await context_of(request).manager.get(session_id)
        return etag.add_tag(request, response, session.sequence)
    conditional = session_id is not None and policy.entity_tag and "if-match" in request.headers
    etag.set_check(_precondition(request) if conditional else None)
    if not policy.idempotency_key:
        return await handler(request)
    return await handle_once(request, context_of(request).answers, handler)


def _precondition(request: Request) -> etag.Check:
    """`If-Match`, checked once the request is known to be well formed."""

    async def check(given: Mapping[str, Any]) -> None:
        context = context_of(request)
        language = getattr(given.get("body"), "language", None)
        if language is not None:
            context.interpreter.languages[
                language
            ]  # an unknown language is a fault of the form: 422 before 412
        session = await context.manager.get(request.path_params["session_id"])
        etag.check_if_match(request, session.sequence)

    return check
