"""The stream: one WebSocket for a session, both ways.

The server sends `hello`, then `tick` and `changed` as they happen; a reader that is too slow gets
a full `state` and is told what it missed. The client sends `command`, `actions` and `ping`, and is
answered under its own `id`; with `subscribe` it is sent pictures as binary messages
(`service.http.realtime.frame_stream`), until `unsubscribe`. Nothing a client sends can do more here than
over HTTP.

A reader that comes back after a loss says `?after=<event>`, the `event` of the last message it saw, and is
sent only what it missed, if that is still kept. Otherwise, as to anyone, `hello` brings the whole state and
the latest lines of the log, numbered.

Codes it closes with: 1000 the session was deleted, 1008 too many malformed messages or a slip in the address,
1009 a message too large (by the server itself), 1012 the service stops, 4404 no such session.
"""

from __future__ import annotations

import asyncio
from contextlib import suppress
from json import JSONDecodeError
from typing import Annotated, Any, Literal, TypeAlias
from urllib.parse import urlsplit

import structlog
from fastapi import APIRouter
from pydantic import Discriminator, Field, TypeAdapter, ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from service.actions import Action
from service.contract.encode.json import encoded
from service.contract.requests import MAX_ACTIONS, Sent, Strictly
from service.contract.text import Letters
from service.http import json as strictly
from service.http.deps import Context, context_of
from service.http.errors import field_problems, invalid
from service.http.middleware.metrics import metrics_of
from service.http.outcome_json import result_json
from service.http.query_params import check_query
from service.http.realtime import frame_stream as pixels
from service.http.realtime.direct_write import straight_of
from service.http.responses import problem_response
from service.http.routes.ws_tickets import admitted
from service.http.session_json import session_json, told_decision
from service.problems import CrossSite, Internal, Invalid, Malformed, ProblemError
from service.security.guard import client_of, guard_of
from service.sessions.messages import hello_message, state_message
from service.sessions.session import Session
from service.sessions.subscribers import Gone, Missed, Watcher, stamped
from service.sessions.utterance import Utterance

_LOG = structlog.get_logger(__name__)

HELLO_EVENTS = 100
"""Lines of the log that a new reader is given."""

_ASKED = frozenset(("after",))
_CODES = {404: 4404, 422: 1008}

router = APIRouter()

Id = Annotated[str, Field(max_length=100, description="Chosen by the client, given back with the answer.")]


class Command(Sent):
    """Something said."""

    type: Literal["command"]
    id: Id
    text: Letters
    dry_run: bool = False
    language: str | None = Field(None, max_length=16)


class Actions(Sent):
    """Typed actions."""

    type: Literal["actions"]
    id: Id
    actions: Strictly[list[Action]] = Field(min_length=1, max_length=MAX_ACTIONS)
    dry_run: bool = False


class Ping(Sent):
    """Is anyone there."""

    type: Literal["ping"]


class Subscribe(Sent):
    """Show me pictures as well; a second one takes the place of the first."""

    type: Literal["subscribe"]
    frames: pixels.Form
    view: pixels.View = "road"
    fps: int = Field(30, ge=1, le=60)
    side: int = Field(480, ge=64, le=1080)


class Unsubscribe(Sent):
    """No more pictures."""

    type: Literal["unsubscribe"]


Message: TypeAlias = Command | Actions | Ping | Subscribe | Unsubscribe
_MESSAGE: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Discriminator("type")])


@router.websocket("/sessions/{session_id}/stream")
async def stream(socket: WebSocket, session_id: str) -> None:
    """Both directions until either side ends it."""
    if not _same_site(socket):
        refusal = CrossSite("The stream can only be opened by this service's own page, or by no page at all.")
        await socket.send_denial_response(problem_response(refusal))
        return
    await socket.accept()
    if not await admitted(socket):
        return
    context = context_of(socket)
    try:
        check_query(socket.query_params.multi_items(), _ASKED)
        session = await context.manager.get(session_id)
    except ProblemError as problem:
        with suppress(WebSocketDisconnect):
            await _send(socket, _error(problem))
            await socket.close(_CODES.get(problem.status, 1013))
        return
    missed = session.watchers.missed(socket.query_params.get("after", ""))
    watcher = session.watchers.join(missed or (), straight_of(socket.scope))
    first = hello(context, session) if missed is None else None
    # Two tasks for a socket: a reader that answers, and a writer that passes on what is published and was
    # not taken straight.
    writer = asyncio.create_task(_write(socket, session, watcher, first))
    screen = _Screen(socket, context, session)
    try:
        await _read(socket, context, session, screen)
    except WebSocketDisconnect:
        pass  # it went before it could be answered; what it asked for is done
    finally:
        session.watchers.leave(watcher)
        screen.dark()
        writer.cancel()
        await asyncio.wait([writer])


class _Screen:
    """Where one socket is sent pictures, once it has asked for them."""

    def __init__(self, socket: WebSocket, context: Context, session: Session) -> None:
        self._socket, self._context, self._session = socket, context, session
        self._task: asyncio.Task[None] | None = None

    def show(self, asked: Subscribe) -> None:
        """These pictures from now on, and no others."""
        self.dark()
        self._task = asyncio.create_task(self._show(asked))

    def dark(self) -> None:
        """No more pictures."""
        if self._task is not None:
            self._task.cancel()
            self._task = None

    async def _show(self, asked: Subscribe) -> None:
        wanted = pixels.Wanted(asked.view, asked.frames, asked.side)
        with suppress(WebSocketDisconnect, RuntimeError):  # the client has gone; the reader hears of it
            await self._context.reels.pass_on(
                self._session, wanted, asked.fps, self._context.drawing, self._socket.send_bytes
            )


async def _write(socket: WebSocket, session: Session, watcher: Watcher, first: bytes | None) -> None:
    """Pass on what is published, at the pace of whoever reads."""
    try:
        if first is not None:
            await _send(socket, first)
        while True:
            heard = await watcher.next()
            match heard:
                case Gone():
                    await _send(socket, encoded({"type": "gone"}))
                    await socket.close(1000)
                    return
                case Missed():
                    state = state_message(session.standing, session.run, heard)
                    await _send(socket, stamped(state, session.watchers.event))
                case notices:
                    for notice in notices:
                        await _send(socket, notice.data)
    except (WebSocketDisconnect, RuntimeError):
        # The client went while being written to; the reader hears of it and ends the connection.
        return


async def _read(socket: WebSocket, context: Context, session: Session, screen: _Screen) -> None:
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
            await _send(socket, await _answer(socket, context, session, message, screen))
    with suppress(RuntimeError):
        await socket.close(1008, "too many malformed messages")


def _message(text: str | None) -> Message:
    """What was sent. Raises `Malformed` or `Invalid`."""
    if text is None:
        raise Malformed("Messages are text, not binary.")
    try:
        values = strictly.loads(text)
    except JSONDecodeError as error:
        raise Malformed(f"The message cannot be read as JSON: {error.msg}.") from error
    try:
        return _MESSAGE.validate_python(values)
    except ValidationError as error:
        told = field_problems(error.errors(), values, Message)
        if not told[0].field:
            raise Invalid(f"The message {told[0].message}.", errors=told) from error
        raise invalid(told) from error


async def _answer(
    socket: WebSocket, context: Context, session: Session, message: Message, screen: _Screen
) -> bytes:
    """The answer to one message, under its id."""
    match message:
        case Subscribe():
            screen.show(message)
            return encoded(message.model_dump() | {"type": "subscribed"})
        case Unsubscribe():
            screen.dark()
            return encoded({"type": "unsubscribed"})
        case Ping():
            return encoded({"type": "pong"})
        case Command() | Actions():
            try:
                guard_of(socket).count_change(client_of(socket.scope))
                with metrics_of(socket).command("socket"):
                    result = await _done(context, session, message)
            except ProblemError as problem:
                return encoded({"type": "problem", "id": message.id, "problem": problem.document()})
            except Exception:
                _LOG.exception("a message failed", session=session.id)
                return encoded({"type": "problem", "id": message.id, "problem": Internal().document()})
            return encoded({"type": "result", "id": message.id, "result": result})


async def _done(context: Context, session: Session, message: Command | Actions) -> dict[str, Any]:
    heard = None
    if isinstance(message, Command):
        heard = await context.listener.hear(message.text, session, message.language)
        utterance = heard.utterance
    else:
        utterance = Utterance(actions=tuple(message.actions))
    outcome = await context.listener.do(session, utterance, dry_run=message.dry_run)
    return result_json(outcome, heard, message.dry_run)


def hello(context: Context, session: Session) -> bytes:
    """The first message: all there is to go on from."""
    latest = session.latest_decision()
    decision = told_decision(session.words, latest[1], latest[0]) if latest else None
    log = session.log.latest(HELLO_EVENTS)
    sentence = context.listener.sentence(session.run.config, session.language)
    told = hello_message(session_json(session, sentence), session.state(), log, decision, session.sequence)
    return stamped(told, session.watchers.event)


def _same_site(socket: WebSocket) -> bool:
    """Browsers name the page that opens a socket; a page of another site must not drive a session."""
    origin = socket.headers.get("origin")
    return origin is None or urlsplit(origin).netloc == socket.headers.get("host")


def _error(problem: ProblemError) -> bytes:
    return encoded({"type": "error", "problem": problem.document()})


async def _send(socket: WebSocket, data: bytes) -> None:
    """One text message, already encoded. Raises `WebSocketDisconnect` where nobody is there any more."""
    try:
        await socket.send({"type": "websocket.send", "text": data.decode()})
    except RuntimeError as gone:  # the other of the two tasks was told first
        raise WebSocketDisconnect(1006) from gone
