"""FastAPI dependencies: the parts of the running service, and the session that a request is about."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, cast

from anyio import CapacityLimiter
from fastapi import Depends, Response
from starlette.requests import HTTPConnection
from starlette.types import Scope

from service.http.conditional.answers import KeptAnswers
from service.http.metrics import Metrics
from service.http.realtime.frame_stream import Reels
from service.http.realtime.open_streams import OpenStreams
from service.interpreter.interpreter import Interpreter
from service.jobs import JobRunner
from service.security.guard import Guard
from service.sessions.manager import SessionManager
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.scheduler.clock import Clock
from service.sessions.session import Session
from service.settings import Settings
from service.store import Store
from service.work.long_answers import LongAnswers


@dataclass(frozen=True, slots=True)
class Context:
    """The parts of one running service; made in `create_app`, reached from any request or WebSocket."""

    settings: Settings
    store: Store
    clock: Clock
    interpreter: Interpreter
    narrator: NarratorProtocol
    manager: SessionManager
    guard: Guard
    metrics: Metrics
    answers: KeptAnswers
    """what was answered under idempotency keys"""
    jobs: JobRunner
    drawing: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(1))
    """one picture at a time"""
    backups: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(1))
    """one backup at a time"""
    reels: Reels = field(default_factory=Reels)
    long_answers: LongAnswers[Response] = field(default_factory=LongAnswers)
    event_streams: OpenStreams = field(default_factory=OpenStreams)


def context_in(scope: Scope) -> Context:
    """The context of the application that an ASGI scope belongs to."""
    return cast(Context, scope["app"].state.context)


def context_of(connection: HTTPConnection) -> Context:
    """The context of the application that a request or WebSocket belongs to."""
    return context_in(connection.scope)


async def _session(session_id: str, connection: HTTPConnection) -> Session:
    return await context_of(connection).manager.get(session_id)


async def _here(connection: HTTPConnection) -> Context:
    # A coroutine, although it waits for nothing: FastAPI calls a plain function in a thread.
    return context_of(connection)


Here = Annotated[Context, Depends(_here)]
TheSession = Annotated[Session, Depends(_session)]
