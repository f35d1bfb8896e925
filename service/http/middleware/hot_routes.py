"""A short way for what is said and done to a session, past routes and their dependencies.

Finding a route and solving its dependencies takes three times as long as doing what was asked. A request
whose form is right at a glance (JSON under that name, a body its model takes, no question in the URL) is
given to the endpoint itself, with the same session, terms and keys as on the long way. Every rule is the
route's own: the endpoint, its model and what surrounds all handlers (`kept`). Whatever is not plainly right
goes the long way, untouched, which says what is wrong with it.
"""

from __future__ import annotations

import inspect
from collections.abc import Awaitable, Callable, Iterable
from json import JSONDecodeError
from typing import Any, NamedTuple, get_type_hints

from fastapi import Request, Response
from fastapi.routing import APIRoute
from pydantic import BaseModel, ValidationError
from starlette.routing import BaseRoute
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http import json as strictly
from service.http.conditional.dependency import kept_contract
from service.http.conditional.etag import terms_of
from service.http.deps import context_of
from service.http.errors import respond
from service.http.session_json import PREFIX
from service.problems import ProblemError
from service.store import StoreError

_BEFORE = f"{PREFIX}/sessions/"
_IN_PATH = "/sessions/{session_id}/"
_ABOUT_BODIES = frozenset((b"content-type", b"content-encoding"))


class _Call(NamedTuple):
    """An endpoint, the model of its body, and whether it asks for terms."""

    endpoint: Callable[..., Awaitable[Response]]
    body: type[BaseModel]
    on_terms: bool


class Plainly:
    """Answers calls by POST about a session that need nothing but a body, a session and terms."""

    def __init__(self, app: ASGIApp, routes: Iterable[BaseRoute]) -> None:
        """`routes` are those to be found by the short way; each takes `body`, `session`, `here`, `terms`?."""
        self._app = app
        self._calls = dict(_calls(routes))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection."""
        call = self._asked(scope)
        if call is None:
            await self._app(scope, receive, send)
            return
        first = await receive()
        waiting = [first]

        async def again() -> Message:
            return waiting.pop() if waiting else await receive()

        body = _read(first, call.body)
        if body is None:
            await self._app(scope, again, send)
            return
        await (await _answer(Request(scope, again), call, body))(scope, receive, send)

    def _asked(self, scope: Scope) -> _Call | None:
        if scope["type"] != "http" or scope["method"] != "POST" or scope["query_string"]:
            return None
        path: str = scope["path"]
        if not path.startswith(_BEFORE):
            return None
        session_id, _, name = path[len(_BEFORE) :].partition("/")
        call = self._calls.get(name)
        if call is None or not session_id or not _says_json(scope["headers"]):
            return None
        scope["path_params"] = {"session_id": session_id}
        return call


async def _answer(request: Request, call: _Call, body: BaseModel) -> Response:
    """What the route answers."""

    async def handler(request: Request) -> Response:
        here = context_of(request)
        session = await here.manager.get(request.path_params["session_id"])
        if call.on_terms:
            return await call.endpoint(body=body, session=session, here=here, terms=await terms_of(request))
        return await call.endpoint(body=body, session=session, here=here)

    try:
        return await kept_contract(request, handler)
    except (ProblemError, StoreError) as error:
        return respond(request, error)


def _calls(routes: Iterable[BaseRoute]) -> Iterable[tuple[str, _Call]]:
    for route in routes:
        if isinstance(route, APIRoute) and route.path.startswith(_IN_PATH) and route.methods == {"POST"}:
            hints = get_type_hints(inspect.unwrap(route.endpoint))
            yield route.path.removeprefix(_IN_PATH), _Call(route.endpoint, hints["body"], "terms" in hints)


def _says_json(headers: Iterable[tuple[bytes, bytes]]) -> bool:
    said = [value for name, value in headers if name in _ABOUT_BODIES]
    return said == [b"application/json"]


def _read(message: Message, model: type[BaseModel]) -> Any:
    """The body, where it came whole and is what the model takes; else None."""
    if message["type"] != "http.request" or message.get("more_body", False):
        return None
    try:
        return model.model_validate(strictly.loads(message["body"]))
    except (JSONDecodeError, ValidationError):
        return None
