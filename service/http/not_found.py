"""What stands near an address at which nothing is, so that a slip is told as one."""

from __future__ import annotations

from difflib import get_close_matches

from fastapi import APIRouter
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from service.http.responses import problem_response
from service.http.session_json import PREFIX
from service.problems import NotFound

_MOST_CHARS = 120
"""Longer addresses are no slips."""
_NEAR = 0.8
_IN_SESSION = "/sessions/"


class Addresses:
    """Those that a service answers at."""

    def __init__(self) -> None:
        self._templates = {"/docs", "/openapi.json"}
        self._sockets: set[str] = set()

    def add(self, router: APIRouter, prefix: str = "") -> None:
        """Those of a router."""
        for route in router.routes:
            if isinstance(route, WebSocketRoute):
                self._sockets.add(prefix + route.path)
            elif isinstance(route, Route):
                self._templates.add(prefix + route.path)

    def near(self, path: str) -> str | None:
        """A sentence about what may have been meant; None where nothing is near."""
        if len(path) > _MOST_CHARS:
            return None
        asked, session = _as_template(path.rstrip("/"))
        if asked in self._sockets:
            return "This is a WebSocket; by plain HTTP, the same can be read at …/events/stream."
        close = [tried for tried in (asked, PREFIX + asked) if tried in self._templates]
        close = close or get_close_matches(asked, self._templates, n=1, cutoff=_NEAR)
        return f"Did you mean {close[0].replace('{session_id}', session)}?" if close else None


def _as_template(path: str) -> tuple[str, str]:
    """An address with the session's id as a template has it, and that id."""
    before, found, rest = path.partition(_IN_SESSION)
    session, slash, after = rest.partition("/")
    return (f"{before}{found}{{session_id}}{slash}{after}", session) if session else (path, "")


def told_sockets(elsewhere: ASGIApp) -> ASGIApp:
    """What stands where no route does: sockets are told so, which a router would leave at a bare 403."""

    async def nowhere(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "websocket":
            await elsewhere(scope, receive, send)
            return
        said = f"There is no WebSocket at {scope['path']}; a session's is at {PREFIX}/sessions/{{id}}/stream."
        await WebSocket(scope, receive, send).send_denial_response(problem_response(NotFound(said)))

    return nowhere
