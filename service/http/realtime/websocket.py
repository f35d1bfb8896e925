"""`/sessions/{id}/stream`: the stream of a session as a WebSocket, both ways.

The server sends `hello`, then `tick` and `changed` as they happen; a client that is too slow gets a full
`state` that names what it missed. The client sends `command`, `actions` and `ping`, and gets each answer
under its own `id`, once for each `key`; with `subscribe` it gets pictures as binary messages
(`service.http.realtime.frame_stream`), until `unsubscribe`. Nothing a client sends can do more here than over
HTTP.

A client that reconnects sends `?after=<event>`, the `event` of the last message it saw, and gets what it
missed, if that is still kept. Otherwise it gets `hello`, as any client.

Close codes: 1000 the session was deleted, 1008 too many malformed messages or an unknown parameter, 1009 a
message too large (uvicorn), 1012 the service stops, 4401 no key and no ticket, 4404 no such session.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from json import JSONDecodeError
from typing import Any, TypeAlias

import structlog
from fastapi import APIRouter
from pydantic import ConfigDict, TypeAdapter, ValidationError
from starlette.types import Message
from starlette.websockets import WebSocket, WebSocketDisconnect

from service.contract.encode.json import encoded
from service.contract.stream_requests import Actions, Command, Ping, StreamRequest, Subscribe, Unsubscribe
from service.http import json
from service.http.asker import UNNAMED
from service.http.deps import Context, context_of
from service.http.outcome_json import result_json
from service.http.query_params import check_query
from service.http.realtime import frame_stream
from service.http.realtime.direct_write import direct_write_of
from service.http.realtime.hello import hello
from service.http.realtime.once import run_once
from service.http.realtime.websocket_auth import authenticate
from service.http.session_json import PREFIX
from service.http.ticks import check_tick
from service.http.validation import field_problems, invalid
from service.interpreter.owners import ask_as
from service.problems import Internal, Invalid, Malformed, ProblemError
from service.security.guard import client_of
from service.sessions.messages import state_message
from service.sessions.preconditions import Preconditions
from service.sessions.session import Session
from service.sessions.subscribers import MissedTicks, SessionDeleted, Subscriber, add_event_id
from service.sessions.utterance import Outcome, Utterance
from service.work.asker import CURRENT_ASKER, Asker
from sim.render import Look

_LOG = structlog.get_logger(__name__)

_QUERY = frozenset(("after",))
_CODES = {404: 4404, 422: 1008}

MOST_UNANSWERED = 8
"""Messages of one client that wait to be answered; the rest stays in its own buffers."""

_Inbox: TypeAlias = "asyncio.Queue[Message | None]"
"""What was received; None once the client has gone."""

_MESSAGE: TypeAdapter[StreamRequest] = TypeAdapter(StreamRequest, config=ConfigDict(defer_build=True))

router = APIRouter(prefix=PREFIX)


@router.websocket("/sessions/{session_id}/stream")
async def stream(socket: WebSocket, session_id: str) -> None:
    """Both directions until either side ends it."""
    await socket.accept()
    if not await authenticate(socket):
        return
    context = context_of(socket)
    ask_as(client_of(socket.scope))
    try:
        check_query(socket.query_params.multi_items(), _QUERY)
        session = await context.manager.get(session_id)
    except ProblemError as problem:
        with suppress(WebSocketDisconnect):
            await _send(socket, _error(problem))
            await socket.close(_CODES.get(problem.status, 1013))
        return
    await session.load_latest_decision()
    missed = session.subscribers.messages_since(socket.query_params.get("after", ""))
    subscriber = session.subscribers.subscribe(missed or (), direct_write_of(socket.scope))
    first = hello(context, session) if missed is None else None
    # Two tasks: a reader that answers, and a writer that sends what was not written directly.
    writer = asyncio.create_task(_write(socket, session, subscriber, first))
    screen = _Screen(socket, context, session)
    try:
        await _read(socket, context, session, screen)
    except WebSocketDisconnect:
        pass  # it went before it could be answered; what it asked for is done
    finally:
        session.subscribers.unsubscribe(subscriber)
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
        look = Look(asked.theme, asked.boxes, asked.figures, asked.path, asked.forecast)
        wanted = frame_stream.Wanted(asked.view, asked.frames, asked.side, look)
        with suppress(WebSocketDisconnect, RuntimeError):  # the client has gone; the reader hears of it
            await self._context.reels.stream_to(
                self._session, wanted, asked.fps, self._context.drawing, self._socket.send_bytes
            )


async def _write(socket: WebSocket, session: Session, subscriber: Subscriber, first: bytes | None) -> None:
    """Pass on what is published, at the pace of whoever reads."""
    try:
        if first is not None:
            await _send(socket, first)
        while True:
            heard = await subscriber.next()
            match heard:
                case SessionDeleted():
                    await _send(socket, encoded({"type": "gone"}))
                    await socket.close(1000)
                    return
                case MissedTicks():
                    state = state_message(session.state_body(), heard)
                    await _send(socket, add_event_id(state, session.subscribers.last_event_id))
                case notices:
                    for notice in notices:
                        await _send(socket, notice.data)
    except (WebSocketDisconnect, RuntimeError):
        # The client went while being written to; the reader hears of it and ends the connection.
        return


async def _read(socket: WebSocket, context: Context, session: Session, screen: _Screen) -> None:
    """Answer what the client sends until it goes, or sends too much rubbish."""
    inbox: _Inbox = asyncio.Queue(MOST_UNANSWERED)
    gone = asyncio.Event()
    token = CURRENT_ASKER.set(Asker(client_of(socket.scope) or UNNAMED, gone.wait))
    receiving = asyncio.create_task(_receive(socket, inbox, gone))
    try:
        await _answer_all(socket, context, session, screen, inbox)
    finally:
        receiving.cancel()
        await asyncio.wait([receiving])
        CURRENT_ASKER.reset(token)


async def _receive(socket: WebSocket, inbox: _Inbox, gone: asyncio.Event) -> None:
    """Take in what is sent, as far as there is room; dear work for a client that has gone is ended."""
    while (received := await socket.receive())["type"] != "websocket.disconnect":
        await inbox.put(received)
    gone.set()
    await inbox.put(None)


async def _answer_all(
    socket: WebSocket, context: Context, session: Session, screen: _Screen, inbox: _Inbox
) -> None:
    """Answer one message after another, in their order; others have a turn after each."""
    malformed = 0
    while malformed < context.settings.max_malformed_messages:
        await asyncio.sleep(0)
        received = await inbox.get()
        if received is None:
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


def _message(text: str | None) -> StreamRequest:
    """What was sent. Raises `Malformed` or `Invalid`."""
    if text is None:
        raise Malformed("Messages are text, not binary.")
    try:
        values = json.loads(text)
    except JSONDecodeError as error:
        raise Malformed(f"The message cannot be read as JSON: {error.msg}.") from error
    try:
        return _MESSAGE.validate_python(values)
    except ValidationError as error:
        problems = field_problems(error.errors(), values, StreamRequest)
        if not problems[0].field:
            raise Invalid(f"The message {problems[0].message}.", errors=problems) from error
        raise invalid(problems) from error


async def _answer(
    socket: WebSocket, context: Context, session: Session, message: StreamRequest, screen: _Screen
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
                context.guard.count_change(client_of(socket.scope))
                with context.metrics.command("socket"):
                    result, replayed = await _run(context, session, message)
            except ProblemError as problem:
                return encoded({"type": "problem", "id": message.id, "problem": problem.document()})
            except Exception:
                _LOG.exception("a message failed", session=session.id)
                return encoded({"type": "problem", "id": message.id, "problem": Internal().document()})
            again = {"replayed": True} if replayed else {}
            return encoded({"type": "result", "id": message.id, "result": result} | again)


async def _run(context: Context, session: Session, message: Command | Actions) -> tuple[dict[str, Any], bool]:
    """The result of a message, and whether it was given before. Raises a `ProblemError`."""

    async def run(
        preconditions: Callable[[Callable[[Outcome], dict[str, Any]]], Preconditions],
    ) -> dict[str, Any]:
        heard = None
        check_tick(message.at_tick, session.timeline.tick, "at_tick")
        if isinstance(message, Command):
            heard = await context.interpreter.interpret(
                message.text, session, message.language, asks=not message.dry_run, at_tick=message.at_tick
            )
            utterance = heard.utterance
        else:
            utterance = Utterance(actions=tuple(message.actions), at_tick=message.at_tick)

        def told(outcome: Outcome) -> dict[str, Any]:
            return result_json(outcome, heard, message.dry_run)

        return told(
            await context.interpreter.execute(
                session, utterance, dry_run=message.dry_run, preconditions=preconditions(told)
            )
        )

    return await run_once(context.answers, session.id, message, run)


def _error(problem: ProblemError) -> bytes:
    return encoded({"type": "error", "problem": problem.document()})


async def _send(socket: WebSocket, data: bytes) -> None:
    """One text message, already encoded. Raises `WebSocketDisconnect` where nobody is there any more."""
    try:
        await socket.send({"type": "websocket.send", "text": data.decode()})
    except RuntimeError as gone:  # the other of the two tasks was told first
        raise WebSocketDisconnect(1006) from gone
