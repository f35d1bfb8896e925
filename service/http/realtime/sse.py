"""`/sessions/{id}/events/stream`: the stream of a session as server-sent events (SSE), read-only.

The messages are those of the WebSocket, byte for byte: `hello`, `tick`, `changed`, `state`, `gone`, each with
an id. A client that reconnects sends the last id it saw (`Last-Event-ID`, as browsers do by themselves) and
gets what it missed, if that is still kept; otherwise `hello` again. Slow clients are treated as on the
WebSocket. When the service stops, the last event is `stopping`, with the close code of the WebSocket, 1012.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Annotated, Any

from fastapi import Header, Query, Response
from fastapi.responses import StreamingResponse

from service.contract.encode.json import encoded
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.realtime.hello import hello
from service.http.realtime.open_streams import OpenStreams
from service.http.route import api_router
from service.http.route_policy import policy
from service.problems import Invalid, NotRestorable, UnknownSession
from service.sessions.messages import state_message
from service.sessions.session import Session
from service.sessions.subscribers import MissedTicks, SessionDeleted, Subscriber, add_event_id

HEARTBEAT_S = 15
"""After so much silence a comment is sent, so that a client that has gone is noticed."""

RETRY_MS = 1_000
"""How long browsers wait before they reconnect."""

MEDIA_TYPE = "text/event-stream"

router = api_router("watching")


_DOCUMENTED: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "Events, until either side ends it.",
        "content": {MEDIA_TYPE: {"schema": {"description": "Events with id, event and data."}}},
    }
}


@router.get(
    "/sessions/{session_id}/events/stream",
    response_class=Response,
    summary="Watch, by server-sent events",
    responses=_DOCUMENTED | problem_responses(UnknownSession, Invalid, NotRestorable),
)
@policy(entity_tag=False)
async def stream_events(
    session: TheSession,
    here: Here,
    last_event_id: Annotated[
        str | None, Header(max_length=100, description="The id of the last event that was seen.")
    ] = None,
    after: Annotated[
        str | None, Query(max_length=100, description="The same, for those who cannot send headers.")
    ] = None,
) -> Response:
    """`hello`, then `tick` and `changed` as they happen; `state` to a reader that was too slow.

    Each event is one JSON object, as on the socket. The last is `gone` (the session was deleted) or
    `stopping` (the service stops: come back later).
    """
    streams = here.event_streams
    await session.load_latest_decision()

    async def body() -> AsyncIterator[bytes]:
        # Joins when the body is first read: a response that is never read leaves no reader behind.
        missed = session.subscribers.messages_since(last_event_id or after or "")
        subscriber = session.subscribers.subscribe(missed or ())
        first = _event(hello(here, session), session.subscribers.last_event_id) if missed is None else b""
        streams.add(subscriber)
        try:
            yield b"retry: %d\n\n" % RETRY_MS + first
            async for part in _read_events(session, subscriber, streams):
                yield part
        finally:
            streams.remove(subscriber)
            session.subscribers.unsubscribe(subscriber)

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(body(), media_type=MEDIA_TYPE, headers=headers)


async def _read_events(
    session: Session, subscriber: Subscriber, streams: OpenStreams
) -> AsyncIterator[bytes]:
    """What is published, at the pace of the client."""
    while True:
        try:
            heard = await asyncio.wait_for(subscriber.next(), HEARTBEAT_S)
        except TimeoutError:
            yield b": still here\n\n"
            continue
        match heard:
            case SessionDeleted():
                last = {"type": "stopping", "code": 1012} if streams.stopping else {"type": "gone"}
                yield _event(encoded(last), None)
                return
            case MissedTicks():
                event = session.subscribers.last_event_id
                yield _event(add_event_id(state_message(session.state_body(), heard), event), event)
            case notices:
                # In one piece: fewer turns of the loop for a reader that keeps up.
                events = session.subscribers.event_id
                yield b"".join(_event(notice.data, events(notice.number)) for notice in notices)


def _event(data: bytes, event: str | None) -> bytes:
    """One event; its name is the message's `type`, which stands first."""
    name = data[9 : data.index(b'"', 9)]
    named = b"" if event is None else b"id: " + event.encode() + b"\n"
    return named + b"event: " + name + b"\ndata: " + data + b"\n\n"
