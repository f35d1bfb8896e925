"""Direct calls: endpoints called without FastAPI's dependency solving, for the few calls that are made most.

FastAPI takes three times as long to solve a call's dependencies as the service to do it (`python -m
bench.rest`, state and commands). A request that is plainly right (no query, JSON that the body's model
accepts) therefore calls its endpoint with the same session, body and preconditions that FastAPI would find.
Any other request goes the ordinary way, which says what is wrong with it.
"""

from __future__ import annotations

import inspect
from collections.abc import Awaitable, Callable
from json import JSONDecodeError
from typing import Any, get_type_hints

from fastapi import Request, Response
from pydantic import BaseModel, ValidationError
from starlette.types import Scope

from service.http import json
from service.http.conditional.etag import conditions_of
from service.http.deps import context_of

_PROVIDED = frozenset(("body", "session", "here", "conditions"))
_BODY_HEADERS = frozenset((b"content-type", b"content-encoding"))


class DirectCall:
    """Calls one endpoint whose required parameters are among `body`, `session`, `here` and `terms`."""

    def __init__(self, endpoint: Callable[..., Awaitable[Response]]) -> None:
        parameters = inspect.signature(endpoint).parameters
        self._endpoint = endpoint
        self._needs = frozenset(parameters) & _PROVIDED
        missing = {name for name, each in parameters.items() if each.default is each.empty} - _PROVIDED
        if missing:
            raise TypeError(f"{endpoint.__name__} cannot be called directly: {', '.join(sorted(missing))}")
        self._body: type[BaseModel] | None = get_type_hints(inspect.unwrap(endpoint)).get("body")

    def read(self, scope: Scope, content: bytes) -> tuple[BaseModel | None] | None:
        """The request's body, or None for a request that has to go the ordinary way."""
        if scope["query_string"]:
            return None
        if self._body is None:
            return (None,)
        about = [value for name, value in scope["headers"] if name in _BODY_HEADERS]
        if about != [b"application/json"]:
            return None
        try:
            return (self._body.model_validate(json.loads(content)),)
        except (JSONDecodeError, ValidationError):
            return None

    async def __call__(self, request: Request, body: BaseModel | None) -> Response:
        """Calls the endpoint. Raises what the ordinary way raises."""
        here = context_of(request)
        given: dict[str, Any] = {"session": await here.manager.get(request.path_params["session_id"])}
        if "body" in self._needs:
            given["body"] = body
        if "here" in self._needs:
            given["here"] = here
        if "conditions" in self._needs:
            given["conditions"] = await conditions_of(request)
        return await self._endpoint(**given)
