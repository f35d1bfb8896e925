"""A socket and a stream of events straight into an application: no server, no port, no thread."""

from __future__ import annotations

import asyncio
import json
from contextlib import suppress
from typing import Any

from starlette.types import ASGIApp, Message

HEADERS = [(b"host", b"localhost")]


class Wire:
    """One connection to an application, both ways."""

    def __init__(self, app: ASGIApp, scope: dict[str, Any], first: Message) -> None:
        self._incoming: asyncio.Queue[Message] = asyncio.Queue()
        self._incoming.put_nowait(first)
        self.sent: list[Message] = []
        self.ended = False
        path, _, query = scope.pop("path").partition("?")
        whole = {
            "asgi": {"version": "3.0", "spec_version": "2.3"},
            "http_version": "1.1",
            "headers": HEADERS,
            "client": ("127.0.0.1", 50_000),
            "server": ("localhost", 8000),
            "root_path": "",
            "path": path,
            "raw_path": path.encode(),
            "query_string": query.encode(),
            **scope,
        }
        self._task = asyncio.create_task(self._run(app, whole))

    async def _run(self, app: ASGIApp, scope: dict[str, Any]) -> None:
        try:
            await app(scope, self._incoming.get, self._send)
        finally:
            self.ended = True

    async def _send(self, message: Message) -> None:
        self.sent.append(message)

    def put(self, message: Message) -> None:
        self._incoming.put_nowait(message)

    async def end(self, message: Message) -> None:
        """Hang up."""
        self.put(message)
        await asyncio.wait([self._task], timeout=60)
        self._task.cancel()
        with suppress(asyncio.CancelledError):
            await self._task


class Socket(Wire):
    """A session's stream."""

    def __init__(self, app: ASGIApp, path: str, asked: str = "") -> None:
        """`asked`: what follows the address."""
        scope = {"type": "websocket", "scheme": "ws", "path": f"{path}/stream{asked}", "subprotocols": []}
        super().__init__(app, scope, {"type": "websocket.connect"})

    @property
    def messages(self) -> list[bytes]:
        """What was sent, as it was."""
        return [each["text"].encode() for each in self.sent if each["type"] == "websocket.send"]

    def say(self, **message: Any) -> None:
        self.put({"type": "websocket.receive", "text": json.dumps(message)})

    async def close(self) -> None:
        await self.end({"type": "websocket.disconnect", "code": 1001})


class Events(Wire):
    """A session's events, as a browser reads them."""

    def __init__(self, app: ASGIApp, path: str, asked: str = "") -> None:
        """`asked`: what follows the address."""
        scope = {"type": "http", "method": "GET", "scheme": "http", "path": f"{path}/events/stream{asked}"}
        super().__init__(app, scope, {"type": "http.request", "body": b"", "more_body": False})

    @property
    def messages(self) -> list[bytes]:
        body = b"".join(each["body"] for each in self.sent if each["type"] == "http.response.body")
        lines = [line for block in body.split(b"\n\n")[:-1] for line in block.split(b"\n")]
        return [line.removeprefix(b"data: ") for line in lines if line.startswith(b"data: ")]

    async def close(self) -> None:
        await self.end({"type": "http.disconnect"})
