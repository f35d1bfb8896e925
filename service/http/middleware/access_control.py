"""What every call passes before anything else looks at it: its host, its page, its key, its rate.

Open to all are the page, its documentation and the signs of life; they tell nothing of any session.
"""

from __future__ import annotations

from collections.abc import Awaitable
from typing import Any

import orjson
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

from service.http.middleware.body_limit import first_header
from service.http.responses import problem_response
from service.http.session_json import PREFIX
from service.problems import CrossSite, ForeignHost, KeyNeeded, ProblemError
from service.security.guard import Guard, client_of
from service.security.hosts import marked_foreign, same_site

_READING = frozenset(("GET", "HEAD", "OPTIONS"))
_ASKING = frozenset(("GET", "HEAD"))
_SESSIONS = f"{PREFIX}/sessions"


class Gate:
    """Refuses what may not come in; counts what does."""

    def __init__(self, app: ASGIApp, guard: Guard) -> None:
        self._app = app
        self._guard = guard

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        if scope["type"] not in ("http", "websocket"):
            return self._app(scope, receive, send)
        try:
            self._check(scope)
        except ProblemError as refusal:
            response = problem_response(refusal)
            if scope["type"] == "websocket":
                return WebSocket(scope, receive, send).send_denial_response(response)
            return response(scope, receive, send)
        if scope["type"] == "http" and self._guard.quotas.kept and scope["path"].startswith(_SESSIONS):
            return self._counted(scope, receive, send)
        return self._app(scope, receive, send)

    def _check(self, scope: Scope) -> None:
        host = first_header(scope, b"host")
        if not self._guard.hosts.answers_to(host, scope):
            raise ForeignHost
        changing = scope["type"] == "websocket" or scope["method"] not in _READING
        if changing and not same_site(first_header(scope, b"origin"), host):
            raise CrossSite("Only this service's own page may do this, or no page at all. Nothing was done.")
        if scope["type"] == "http" and scope["method"] in _ASKING and _guarded(scope["path"]):
            self._check_asking(scope, host)
        # A socket may bring its key, or a ticket, in its first message: pages cannot set its headers.
        if scope["type"] == "websocket" or not _guarded(scope["path"]):
            return
        if not self._guard.key.admits(first_header(scope, b"authorization")):
            raise KeyNeeded
        if changing:
            self._guard.count_change(client_of(scope))

    def _check_asking(self, scope: Scope, host: str | None) -> None:
        """Raise `CrossSite` where a page of another site has its browser ask: it could not read the answer,
        but have it made, and many are costly. Scripts send neither header."""
        origin, mark = first_header(scope, b"origin"), first_header(scope, b"sec-fetch-site")
        if marked_foreign(mark) or not same_site(origin, host):
            raise CrossSite("Only this service's own page may ask this, or no page at all.")

    async def _counted(self, scope: Scope, receive: Receive, send: Send) -> None:
        """A call that may make or end a session."""
        method, parts = scope["method"], scope["path"].removeprefix(_SESSIONS).strip("/").split("/")
        makes = method == "POST" and (parts == [""] or parts[1:] == ["forks"])
        owner = client_of(scope)
        if makes:
            try:
                self._guard.quotas.begin(owner)
            except ProblemError as refusal:
                await problem_response(refusal)(scope, receive, send)
                return
        status = 0
        made: tuple[str | None, int] = (None, 0)

        async def noting(message: Message) -> None:
            nonlocal status, made
            if message["type"] == "http.response.start":
                status = message["status"]
            elif makes and status == 201:
                made = _made(message.get("body", b""))
            await send(message)

        try:
            await self._app(scope, receive, noting)
        finally:
            if makes:
                self._guard.quotas.end(owner, *made)
        if method == "DELETE" and len(parts) == 1 and status == 204:
            self._guard.quotas.gone(parts[0])


def _guarded(path: str) -> bool:
    return path.startswith("/api/") or path == "/metrics"


def _made(body: bytes) -> tuple[str | None, int]:
    """The session that an answer tells of, and the cells of its road."""
    session: dict[str, Any] = orjson.loads(body)
    return session["id"], session["config"]["columns"] * session["config"]["rows"]


def document(method: str, path: str, operation: dict[str, Any], problem: Any) -> None:
    """Tell of the gate in the documentation of a call; `problem` makes an error's documentation."""
    slugs = ["foreign-host"]
    if _guarded(path):
        slugs.append("key-needed")
        operation["security"] = [{"key": []}, {}]
    if method != "get" or _guarded(path):
        slugs.append("cross-site")
    if method != "get":
        slugs.append("too-many-changes")
    if method == "post" and (path == _SESSIONS or path.endswith("/forks")):
        slugs.append("over-quota")
    problem(operation, *slugs)
