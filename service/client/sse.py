"""Server-sent events as the messages they carry, for networks through which no socket passes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

import httpx

from service.client.endpoints import PREFIX
from service.client.errors import UnexpectedAnswer
from service.client.messages import Message
from service.client.stream_reader import StreamReader

SILENCE_S = 45.0
"""The service says that it is still there every 15 s; after so much silence it is not."""

_MOST_BYTES = 16 * 2**20
"""Of one event."""


class EventStreamReader(StreamReader):
    """One reader's place in a stream of events, kept over lost connections. It opens no connection itself."""

    def request(self, timeout_s: float) -> dict[str, Any]:
        """What httpx is given to open the stream, or to open it again."""
        headers = {"Accept": "text/event-stream"}
        if self.after is not None:
            headers["Last-Event-ID"] = self.after
        return {
            "method": "GET",
            "url": f"{PREFIX}/sessions/{quote(self.session, safe='')}/events/stream",
            "headers": headers,
            "timeout": httpx.Timeout(timeout_s, read=SILENCE_S),
        }

    def check(self, response: httpx.Response) -> None:
        """Accepts a connection. Raises `UnexpectedAnswer` where that is no stream of events."""
        if not response.headers.get("content-type", "").startswith("text/event-stream"):
            raise UnexpectedAnswer(f"What answers at {response.url.host} is not this service.")
        self.on_connected()


class EventParser:
    """Cuts bytes into events as they come in."""

    def __init__(self) -> None:
        self._rest = b""
        self._data: list[bytes] = []

    def feed(self, part: bytes, following: EventStreamReader) -> Iterator[Message]:
        """The messages that this part completes. Raises `UnexpectedAnswer`."""
        *lines, self._rest = (self._rest + part).split(b"\n")
        if len(self._rest) > _MOST_BYTES:
            raise UnexpectedAnswer("The stream sent an event without an end.")
        for line in lines:
            if line.startswith(b"data:"):
                self._data.append(line.removeprefix(b"data:").strip())
            elif not line and self._data:
                data, self._data = b"\n".join(self._data), []
                message = following.read(data.decode("utf-8", "replace"))
                if message is not None and message.type != "stopping":
                    yield message
