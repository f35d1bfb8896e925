"""A short way to what is asked for most: the present state of a live session.

Scripts and dashboards ask for it again and again, mostly before anything has moved. So it is encoded once for
as long as it stands, and found before routes and their dependencies are gone through, which takes longer than
all else. Whatever is not plainly that (an earlier tick, a session that is not live, any question in the URL)
goes the long way, which answers the same in the same bytes and headers.
"""

from __future__ import annotations

from collections.abc import Awaitable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

from starlette.requests import Request
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from service.contract.encode.json import encoded
from service.contract.encode.state import Standing, state_json
from service.http.conditional.etag import tagged
from service.http.responses import etag
from service.http.session_json import PREFIX
from service.problems import ProblemError
from service.sessions.manager import SessionManager
from service.sessions.session import Session
from sim.state import SimState

_BEFORE = f"{PREFIX}/sessions/"
_AFTER = "/state"


@dataclass(frozen=True, slots=True)
class _Seen:
    """A state that was encoded, and what it was made from."""

    run: SimState
    standing: Standing
    body: bytes


class Glance:
    """Answers `GET …/state` of a live session; passes on all else."""

    def __init__(self, app: ASGIApp, manager: SessionManager) -> None:
        self._app = app
        self._manager = manager
        self._seen: WeakKeyDictionary[Session, _Seen] = WeakKeyDictionary()

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        session_id = _asked(scope)
        if session_id is None:
            return self._app(scope, receive, send)
        return self._look(session_id, scope, receive, send)

    async def _look(self, session_id: str, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            session = await self._manager.get(session_id)
        except ProblemError:
            await self._app(scope, receive, send)  # the long way says so
        else:
            await self._answer(scope, session)(scope, receive, send)

    def _answer(self, scope: Scope, session: Session) -> Response:
        run, standing = session.run, session.standing
        seen = self._seen.get(session)
        if seen is None or seen.run is not run or seen.standing != standing:
            seen = _Seen(run, standing, encoded(state_json(standing, run)))
            self._seen[session] = seen
        response = Response(seen.body, headers=etag(standing.sequence), media_type="application/json")
        return tagged(Request(scope), response, standing.sequence)


def _asked(scope: Scope) -> str | None:
    """The session whose present state is asked for, and nothing else."""
    if scope["type"] != "http" or scope["method"] != "GET" or scope["query_string"]:
        return None
    path: str = scope["path"]
    if not path.startswith(_BEFORE) or not path.endswith(_AFTER):
        return None
    found = path[len(_BEFORE) : -len(_AFTER)]
    return found if found and "/" not in found else None
