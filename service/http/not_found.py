"""404: what may have been meant by an address at which nothing is, for HTTP and WebSocket."""

from __future__ import annotations

from collections.abc import Iterable

from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket

from service.http.responses import send_problem
from service.http.session_json import PREFIX
from service.problems import NotFound
from service.suggestions import MAX_CHARS, nearest

_LEAST = 0.8
_IN_SESSION = "/sessions/"


def suggest_address(path: str, routes: Iterable[BaseRoute]) -> str | None:
    """A sentence about what may have been meant by a path; None if nothing is near."""
    if len(path) > MAX_CHARS:
        return None
    routes = list(routes)
    asked, session = _as_template(path.rstrip("/"))
    if any(isinstance(route, WebSocketRoute) and route.path == asked for route in routes):
        return "This is a WebSocket; by plain HTTP, the same can be read at …/events/stream."
    # Whole folders (`{path:path}`) are no addresses.
    templates = [each.path for each in routes if isinstance(each, Route) and ":path}" not in each.path]
    close = next((each for each in (asked, PREFIX + asked) if each in templates), None)
    close = close or nearest(asked, templates, _LEAST)
    return f"Did you mean {close.replace('{session_id}', session)}?" if close else None


def _as_template(path: str) -> tuple[str, str]:
    """A path with its session's id as a route has it, and that id."""
    before, found, rest = path.partition(_IN_SESSION)
    session, slash, after = rest.partition("/")
    return (f"{before}{found}{{session_id}}{slash}{after}", session) if session else (path, "")


async def _no_websocket(socket: WebSocket) -> None:
    path = socket.scope["path"]
    detail = f"There is no WebSocket at {path}; a session's is at {PREFIX}/sessions/{{id}}/stream."
    await send_problem(NotFound(detail), socket.scope, socket.receive, socket.send)


NO_WEBSOCKET = WebSocketRoute("/{path:path}", _no_websocket)
"""Stands last: a router would refuse other WebSockets with a bare 403."""
