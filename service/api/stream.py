"""The stream: one WebSocket for a session, both ways.

The server sends `hello`, then `tick` and `changed` as they happen; a reader that is too slow gets
a full `state` and is told what it missed. The client sends `command`, `actions` and `ping`, and is
answered under its own `id`. Nothing a client sends can do more here than over HTTP.

A reader that comes back after a loss says `?after=<sequence>`, the last change it saw. It needs no
other answer than anyone: `hello` brings the whole state and the latest lines of the log, numbered.

Codes it closes with: 1000 the session was deleted, 1008 too many malformed messages, 1009 a
message too large (by the server itself), 1012 the service stops, 4404 no such session.
"""

from __future__ import annotations

import asyncio
from typing import Annotated, Any, Literal
from urllib.parse import urlsplit

import orjson
import structlog
from fastapi import APIRouter
from pydantic import Discriminator, Field, TypeAdapter, ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from service.actions import Action
from service.api.bodies import MAX_ACTIONS, Sent, Strictly
from service.api.context import Context, context_of
from service.api.errors import field_problems, invalid
from service.api.respond import problem_response
from service.api.speech import result_json
from service.api.views import session_json, told_decision
from service.problems import CrossSite, Internal, Malformed, ProblemError
from service.sessions.messages import hello_message, state_message
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.sessions.watchers import Gone, Missed, Watcher
from service.talk.languages import DEFAULT
from service.wire.encode import encoded

_LOG = structlog.get_logger(__name__)

HELLO_EVENTS = 100
"""Lines of the log that a new reader is given."""

router = APIRouter()

Id = Annotated[str, Field(max_length=100, description="Chosen by the client, given back with the answer.")]


class Command(Sent):
    """Something said."""

    type: Literal["command"]
    id: Id
    text: str
    dry_run: bool = False
    language: str = Field(DEFAULT, max_length=16)


class Actions(Sent):
    """Typed actions."""

    type: Literal["actions"]
    id: Id
    actions: Strictly[list[Action]] = Field(min_length=1, max_length=MAX_ACTIONS)
    dry_run: bool = False


class Ping(Sent):
    """Is anyone there."""

    type: Literal["ping"]


_MESSAGE: TypeAdapter[Command | Actions | Ping] = TypeAdapter(
    Annotated[Command | Actions | Ping, Discriminator("type")]
)


@router.websocket("/sessions/{session_id}/stream")
async def stream(socket: WebSocket, session_id: str) -> None:
    """Both directions until either side ends it."""
    if not _same_site(socket):
        refusal = CrossSite("The stream can only be opened by this service's own page, or by no page at all.")
        await socket.send_denial_response(problem_response(refusal))
        return
    await socket.accept()
    context = context_of(socket)
    try:
        session = await context.manager.get(session_id)
    except ProblemError as problem:
        await _send(socket, _error(problem))
        await socket.close(4404 if problem.status == 404 else 1013)
        return
    watcher = session.watchers.join()
    # Two tasks for a socket: a reader that answers, and a writer that passes on what is published.
    writer = asyncio.create_task(_write(socket, session, watcher, _hello(context, session)))
    try:
        await _read(socket, context, session)
    finally:
        session.watchers.leave(watcher)
        writer.cancel()
        await asyncio.wait([writer])


async def _write(socket: WebSocket, session: Session, watcher: Watcher, hello: bytes) -> None:
    """Pass on what is published, at the pace of whoever reads."""
    try:
        await _send(socket, hello)
        while True:
            heard = await watcher.next()
            match heard:
                case Gone():
                    await _send(socket, encoded({"type": "gone"}))
                    await socket.close(1000)
                    return
                case Missed():
                    await _send(socket, state_message(session.standing, session.run, heard))
                case notices:
                    for notice in notices:
                        await _send(socket, notice.data)
    except (WebSocketDisconnect, RuntimeError):
        # The client went while being written to; the reader hears of it and ends the connection.
        return


async def _read(socket: WebSocket, context: Context, session: Session) -> None:
    """Answer what the client sends, in its order, until it goes or sends too much rubbish."""
    malformed = 0
    while malformed < context.settings.max_malformed_messages:
        received = await socket.receive()
        if received["type"] == "websocket.disconnect":
            return
        try:
            message = _message(received.get("text"))
        except ProblemError as problem:
            malformed += 1
            await _send(socket, _error(problem))
        else:
            await _send(socket, await _answer(context, session, message))
    await socket.close(1008, "too many malformed messages")


def _message(text: str | None) -> Command | Actions | Ping:
    """What was sent. Raises `Malformed` or `Invalid`."""
    if text is None:
        raise Malformed("Messages are text, not binary.")
    try:
        values = orjson.loads(text)
    except orjson.JSONDecodeError as error:
        raise Malformed(f"The message cannot be read as JSON: {error.msg}.") from error
    try:
        return _MESSAGE.validate_python(values)
    except ValidationError as error:
        raise invalid(field_problems(error.errors(), values)) from error


async def _answer(context: Context, session: Session, message: Command | Actions | Ping) -> bytes:
    """The answer to one message, under its id."""
    match message:
        case Ping():
            return encoded({"type": "pong"})
        case Command() | Actions():
            try:
                result = await _done(context, session, message)
            except ProblemError as problem:
                return encoded({"type": "problem", "id": message.id, "problem": problem.document()})
            except Exception:
                _LOG.exception("a message failed", session=session.id)
                return encoded({"type": "problem", "id": message.id, "problem": Internal().document()})
            return encoded({"type": "result", "id": message.id, "result": result})


async def _done(context: Context, session: Session, message: Command | Actions) -> dict[str, Any]:
    heard, code = None, DEFAULT
    if isinstance(message, Command):
        code = message.language
        heard = await context.listener.hear(message.text, session, code)
        utterance = heard.utterance
    else:
        utterance = Utterance(actions=tuple(message.actions))
    outcome = await context.listener.do(session, utterance, dry_run=message.dry_run, code=code)
    return result_json(outcome, heard, message.dry_run)


def _hello(context: Context, session: Session) -> bytes:
    latest = session.latest_decision()
    decision = told_decision(context.words, latest[1], latest[0]) if latest else None
    log = session.log.latest(HELLO_EVENTS)
    sentence = context.listener.sentence(session.run.config)
    return hello_message(session_json(session, sentence), session.state(), log, decision, session.sequence)


def _same_site(socket: WebSocket) -> bool:
    """Browsers name the page that opens a socket; a page of another site must not drive a session."""
    origin = socket.headers.get("origin")
    return origin is None or urlsplit(origin).netloc == socket.headers.get("host")


def _error(problem: ProblemError) -> bytes:
    return encoded({"type": "error", "problem": problem.document()})


async def _send(socket: WebSocket, data: bytes) -> None:
    """One text message, already encoded."""
    await socket.send({"type": "websocket.send", "text": data.decode()})
