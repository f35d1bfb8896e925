"""Direct routes: the calls that are made most, answered without the router and FastAPI's dependency solving.

Router and dependencies take FastAPI three times as long as these calls themselves (`python -m bench.rest`,
state and commands). Routes with the policy `direct` are therefore looked up by the last part of their path,
and a request that is plainly right (no query, JSON that the body's model accepts) calls the endpoint with the
same session, body and conditions that FastAPI would find. Any other request goes to the router, which says
what is wrong with it.
"""

from __future__ import annotations

import inspect
from collections.abc import Awaitable, Callable, Iterable
from contextlib import nullcontext
from json import JSONDecodeError
from typing import Any, get_type_hints

from fastapi import Request, Response
from pydantic import BaseModel, ValidationError
from starlette.requests import ClientDisconnect
from starlette.routing import BaseRoute
from starlette.types import ASGIApp, Receive, Scope, Send

from service.http import json
from service.http.access_control import check_access, count_change
from service.http.asker import asked_by
from service.http.body_limit import read_body, receive_again
from service.http.conditional.etag import Conditions, add_tag, conditions_of, set_check
from service.http.conditional.handler import handle_conditionally
from service.http.deps import Context, context_in
from service.http.errors import respond
from service.http.route import ApiRoute
from service.http.session_json import PREFIX
from service.problems import ProblemError
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.session import Session
from service.store import StoreError

_BEFORE = f"{PREFIX}/sessions/"
_TEMPLATE = f"{_BEFORE}{{session_id}}"
_PROVIDED = frozenset(("body", "session", "here", "conditions"))
_CONDITIONAL_HEADERS = frozenset((b"if-match", b"idempotency-key"))
_BODY_HEADERS = frozenset((b"content-type", b"content-encoding"))


class DirectRoutes:
    """Answers requests to direct routes; passes on all others."""

    def __init__(self, app: ASGIApp, routes: Iterable[BaseRoute]) -> None:
        self._app = app
        self._calls = {
            (method, route.path.removeprefix(f"{_TEMPLATE}/")): DirectCall(route)
            for route in routes
            if isinstance(route, ApiRoute) and route.policy.direct
            for method in route.methods or ()
        }

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """Handles one connection."""
        if scope["type"] == "http" and not scope["query_string"]:
            before, _, name = scope["path"].rpartition("/")
            call = self._calls.get((scope["method"], name))
            if call is not None and before.startswith(_BEFORE):
                session_id = before[len(_BEFORE) :]
                if session_id and "/" not in session_id and call.accepts(scope):
                    scope["path_params"] = {"session_id": session_id}
                    return self._answer(call, scope, receive, send)
        return self._app(scope, receive, send)

    async def _answer(self, call: DirectCall, scope: Scope, receive: Receive, send: Send) -> None:
        context = context_in(scope)
        request: Request | None = None
        try:
            check_access(scope, context.guard)
            if call.body_type is None:
                response = await call(Request(scope, receive), context, None)
            else:
                content = await read_body(scope, receive, call.route.body_limit(context.settings))
                request = Request(scope, receive_again(content, receive))
                try:
                    body = call.body_type.model_validate(json.loads(content))
                except (JSONDecodeError, ValidationError):
                    await self._app(scope, request.receive, send)
                    return
                count_change(scope, context.guard)
                timed = call.route.policy.timed
                with asked_by(scope, receive), context.metrics.command("rest") if timed else nullcontext():
                    response = await call(request, context, body)
        except ClientDisconnect:
            return
        except (ProblemError, StoreError) as error:
            response = respond(request or Request(scope, receive), error)
        await response(scope, receive, send)


class DirectCall:
    """Calls the endpoint of a direct route; it takes no more than `_PROVIDED`."""

    def __init__(self, route: ApiRoute) -> None:
        parameters = inspect.signature(route.endpoint).parameters
        required = {name for name, each in parameters.items() if each.default is each.empty}
        if not required <= _PROVIDED or not route.path.startswith(f"{_TEMPLATE}/"):
            raise TypeError(f"{route.path} cannot be a direct route")
        self.route = route
        self.body_type: type[BaseModel] | None = get_type_hints(inspect.unwrap(route.endpoint)).get("body")
        self._endpoint: Callable[..., Awaitable[Response]] = route.endpoint
        self._needs_here = "here" in parameters
        self._needs_conditions = "conditions" in parameters

    def accepts(self, scope: Scope) -> bool:
        """Whether the headers say that the body, if there is to be one, is plain JSON."""
        if self.body_type is None:
            return True
        about = [value for name, value in scope["headers"] if name in _BODY_HEADERS]
        return about == [b"application/json"]

    async def __call__(self, request: Request, context: Context, body: BaseModel | None) -> Response:
        """The response of the endpoint. Raises what the ordinary way raises."""
        session_id = request.scope["path_params"]["session_id"]
        if body is not None and not _is_conditional(request.scope):
            set_check(None)
            session = await context.manager.get(session_id)
            return await self._call_endpoint(session, context, body, _no_conditions)

        async def handle(request: Request) -> Response:
            session = await context.manager.get(session_id)
            conditions = await conditions_of(request) if self._needs_conditions else _no_conditions
            return await self._call_endpoint(session, context, body, conditions)

        if body is None and not self._needs_here:  # the present state: no more than its tag is conditional
            set_check(None)
            session = await context.manager.get(session_id)
            return add_tag(request, await self._endpoint(session=session), session.sequence)

        return await handle_conditionally(request, handle, self.route.policy)

    def _call_endpoint(
        self, session: Session, context: Context, body: BaseModel | None, conditions: Conditions
    ) -> Awaitable[Response]:
        given: dict[str, Any] = {"session": session}
        if body is not None:
            given["body"] = body
        if self._needs_here:
            given["here"] = context
        if self._needs_conditions:
            given["conditions"] = conditions
        return self._endpoint(**given)


def _is_conditional(scope: Scope) -> bool:
    """Whether a request has a header of `service.http.conditional`."""
    return any(name in _CONDITIONAL_HEADERS for name, _ in scope["headers"])


def _no_conditions(_: object) -> Preconditions:
    return NO_PRECONDITIONS
