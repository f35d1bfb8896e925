"""`/sessions/{id}/events/stream`: the stream for those who only read, as server-sent events.

The same messages as on the socket, in the same bytes: `hello`, `tick`, `changed`, `state`, `gone`, each with
an id. Whoever comes back says the last id it saw (`Last-Event-ID`, which browsers send by themselves) and
is sent only what it missed, if that is still kept; otherwise `hello` again. A slow reader is treated as on
the socket. When the service stops, the last event is `stopping`, with the code 1012 of the socket.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Annotated, Any

from fastapi import APIRouter, Header, Query, Response
from fastapi.responses import StreamingResponse
from starlette.requests import Request

from service.contract.encode.json import encoded
from service.http.deps import Here, TheSession
from service.http.errors import documented
from service.http.realtime.websocket import hello
from service.http.responses import StrictRoute
from service.problems import Invalid, NotRestorable, UnknownSession
from service.sessions.messages import state_message
from service.sessions.session import Session
from service.sessions.subscribers import Gone, Missed, Watcher, stamped

KEEP_ALIVE_S = 15
"""After so much silence a comment is sent, so that a reader that has gone is noticed."""

RETRY_MS = 1_000
"""How long browsers are to wait before they come back."""

MEDIA_TYPE = "text/event-stream"

router = APIRouter(tags=["watching"], route_class=StrictRoute)


class Readers:
    """All who read such streams now, to be let go when the service stops."""

    def __init__(self) -> None:
        self.stopping = False
        self._watchers: set[Watcher] = set()

    def add(self, watcher: Watcher) -> None:
        """One more."""
        self._watchers.add(watcher)
        if self.stopping:
            watcher.end()

    def remove(self, watcher: Watcher) -> None:
        """It has gone."""
        self._watchers.discard(watcher)

    def stop(self) -> None:
        """End all streams: a server that stops waits for what is being answered."""
        self.stopping = True
        for watcher in self._watchers:
            watcher.end()


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
    responses=_DOCUMENTED | documented(UnknownSession, Invalid, NotRestorable),
)
async def events_stream(
    session: TheSession,
    here: Here,
    request: Request,
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
    readers: Readers = request.app.state.readers

    async def told() -> AsyncIterator[bytes]:
        # Joined here, so that nobody is left behind of whom nothing was ever read.
        missed = session.watchers.missed(last_event_id or after or "")
        watcher = session.watchers.join(missed or ())
        first = _event(hello(here, session), session.watchers.event) if missed is None else b""
        readers.add(watcher)
        try:
            yield b"retry: %d\n\n" % RETRY_MS + first
            async for part in _told(session, watcher, readers):
                yield part
        finally:
            readers.remove(watcher)
            session.watchers.leave(watcher)

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(told(), media_type=MEDIA_TYPE, headers=headers)


async def _told(session: Session, watcher: Watcher, readers: Readers) -> AsyncIterator[bytes]:
    """What is published, at the pace of whoever reads."""
    while True:
        try:
            heard = await asyncio.wait_for(watcher.next(), KEEP_ALIVE_S)
        except TimeoutError:
            yield b": still here\n\n"
            continue
        match heard:
            case Gone():
                last = {"type": "stopping", "code": 1012} if readers.stopping else {"type": "gone"}
                yield _event(encoded(last), None)
                return
            case Missed():
                event = session.watchers.event
                yield _event(stamped(state_message(session.standing, session.run, heard), event), event)
            case notices:
                # In one piece: fewer turns of the loop for a reader that keeps up.
                events = session.watchers.event_of
                yield b"".join(_event(notice.data, events(notice.number)) for notice in notices)


def _event(data: bytes, event: str | None) -> bytes:
    """One event; its name is the message's `type`, which stands first."""
    name = data[9 : data.index(b'"', 9)]
    named = b"" if event is None else b"id: " + event.encode() + b"\n"
    return named + b"event: " + name + b"\ndata: " + data + b"\n\n"
