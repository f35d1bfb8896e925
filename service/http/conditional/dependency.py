"""What holds for every call alike: keys that do once, tags that say what was last seen.

Stands around the handler of each route, so that no route can forget it.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from fastapi import Request, Response

from service.http.conditional import etag as preconditions
from service.http.conditional import idempotency
from service.http.deps import context_of

Handler = Callable[[Request], Awaitable[Response]]


async def kept_contract(request: Request, handler: Handler) -> Response:
    """Answer a request by its handler, if need be. Raises a `ProblemError`."""
    context = context_of(request)
    if request.method == "GET":
        preconditions.before(None)
        response = await handler(request)
        session_id = request.path_params.get("session_id")
        if session_id is None or response.status_code != 200 or not hasattr(response, "body"):
            return response
        session = await context.manager.get(session_id)
        return preconditions.tagged(request, response, session.sequence)

    async def is_meant(given: Mapping[str, Any]) -> None:
        language = getattr(given.get("body"), "language", None)
        if language is not None:
            context.listener.languages[language]  # which there are belongs to a request's form
        session = await context.manager.get(request.path_params["session_id"])
        preconditions.checked(request, session.sequence)

    asked = "if-match" in request.headers and "session_id" in request.path_params
    preconditions.before(is_meant if asked else None)
    return await idempotency.once(request, context.answers, handler)
