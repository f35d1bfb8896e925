"""What routes work with: bound once in `create_app`, reached from any request or socket."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Annotated, cast

from anyio import CapacityLimiter
from fastapi import Depends
from starlette.requests import HTTPConnection

from service.http.conditional.idempotency import Answers
from service.http.realtime.frame_stream import Reels
from service.interpreter.interpreter import Listener
from service.problems import NotJson
from service.sessions.manager import SessionManager
from service.sessions.narrator_protocol import Words
from service.sessions.scheduler.clock import Clock
from service.sessions.session import Session
from service.settings import Settings
from service.store import Store

_AS_IT_IS = ("", "identity")
_CHARSET = re.compile(r""";[ \t]*charset[ \t]*=[ \t]*"?([^\s;"]+)""", re.IGNORECASE)
_LETTERS = ("utf-8", "utf8", "us-ascii")


@dataclass(frozen=True, slots=True)
class Context:
    """The parts of one running service."""

    settings: Settings
    store: Store
    clock: Clock
    listener: Listener
    words: Words
    manager: SessionManager
    drawing: CapacityLimiter
    """one picture at a time"""
    answers: Answers
    """what was answered under idempotency keys"""
    filming: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(1))
    """one film at a time"""
    reels: Reels = field(default_factory=Reels)


def context_of(connection: HTTPConnection) -> Context:
    """The context a request or socket belongs to."""
    return cast(Context, connection.app.state.context)


async def _session(session_id: str, connection: HTTPConnection) -> Session:
    return await context_of(connection).manager.get(session_id)


async def json_only(connection: HTTPConnection) -> None:
    """Refuse a body that does not say it is JSON, which also keeps other sites' forms out."""
    said = connection.headers.get("content-type", "")
    kind = said.partition(";")[0].strip().lower()
    if kind != "application/json":
        said = f"not as {kind[:100]}" if kind else "and say so in Content-Type"
        raise NotJson(f"Send the body as application/json, {said}. With curl: --json '{{}}'.")


def check_form(connection: HTTPConnection) -> None:
    """Refuse a body that says it is packed, or written in other letters than UTF-8. Raises `NotJson`."""
    packed = connection.headers.get("content-encoding", "").strip().lower()
    if packed not in _AS_IT_IS:
        said = f"Send the body as it is, not packed as {packed[:100]}."
        raise NotJson(said, headers={"Accept-Encoding": "identity"})
    found = _CHARSET.search(connection.headers.get("content-type", ""))
    if found is not None and found[1].lower() not in _LETTERS:
        raise NotJson(f"Send the body in UTF-8, not in {found[1][:100]}.")


async def _here(connection: HTTPConnection) -> Context:
    # A coroutine, although it waits for nothing: a plain function would be called in a thread each time.
    return context_of(connection)


Here = Annotated[Context, Depends(_here)]
TheSession = Annotated[Session, Depends(_session)]
JSON_ONLY = Depends(json_only)
