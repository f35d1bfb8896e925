"""A server in the test's own loop that answers as an OpenAI-compatible one does, or much worse.

Raw sockets, so that it can break every rule of HTTP; it keeps what it was sent, byte for byte.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Reply:
    """One answer: its bytes, and how it ends."""

    head: str
    body: bytes = b""
    missing: int = 0
    """Bytes that are promised and never sent: the connection is closed instead."""
    held: bool = False
    """Nothing is sent until the server is closed."""


def reply(
    body: bytes | str,
    status: int = 200,
    content_type: str = "application/json",
    missing: int = 0,
    extra: str = "",
) -> Reply:
    """A whole HTTP answer."""
    body = body.encode() if isinstance(body, str) else body
    head = (
        f"HTTP/1.1 {status} Whatever\r\ncontent-type: {content_type}\r\n"
        f"content-length: {len(body) + missing}\r\n{extra}\r\n"
    )
    return Reply(head, body, missing)


def says(content: str | None, **more: Any) -> Reply:
    """A completion with this text."""
    choice = {
        "index": 0,
        "finish_reason": "stop",
        "message": {"role": "assistant", "content": content},
        **more,
    }
    return reply(
        json.dumps({"id": "x", "object": "chat.completion", "created": 1, "model": "m", "choices": [choice]})
    )


def acts(*actions: Any) -> Reply:
    """A completion with these actions."""
    return says(json.dumps({"actions": actions}))


HELD = Reply("", held=True)


@dataclass
class Endpoint:
    """Where it is, what it is to answer, and what it was sent."""

    replies: list[Reply] = field(default_factory=list)
    heads: list[str] = field(default_factory=list)
    bodies: list[dict[str, Any]] = field(default_factory=list)
    port: int = 0
    closing: asyncio.Event = field(default_factory=asyncio.Event)
    open: dict[asyncio.Task[Any], asyncio.StreamWriter] = field(default_factory=dict)

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/v1"

    def answers(self, *replies: Reply) -> None:
        """From now on these, and the last of them for ever."""
        self.replies = list(replies)

    def sent(self, number: int = -1) -> Sequence[dict[str, str]]:
        """The messages of a request."""
        messages: list[dict[str, str]] = self.bodies[number]["messages"]
        return messages

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        self.open[task] = writer
        try:
            while not self.closing.is_set():
                head = (await reader.readuntil(b"\r\n\r\n")).decode()
                length = next(
                    int(line.split(":")[1])
                    for line in head.split("\r\n")
                    if line.lower().startswith("content-length")
                )
                self.heads.append(head)
                self.bodies.append(json.loads(await reader.readexactly(length)))
                answer = self.replies[0] if len(self.replies) == 1 else self.replies.pop(0)
                if answer.held:
                    await self.closing.wait()
                    return
                writer.write(answer.head.encode() + answer.body)
                await writer.drain()
                if answer.missing:
                    return
        except (asyncio.IncompleteReadError, ConnectionError):
            pass  # the other side let go
        finally:
            writer.close()
            del self.open[task]


@asynccontextmanager
async def serving() -> AsyncIterator[Endpoint]:
    """One that is closed, with all that it holds back, at the end."""
    endpoint = Endpoint()
    server = await asyncio.start_server(endpoint.serve, "127.0.0.1", 0)
    endpoint.port = server.sockets[0].getsockname()[1]
    try:
        yield endpoint
    finally:
        endpoint.closing.set()
        server.close()
        for writer in endpoint.open.values():
            writer.close()
        await asyncio.gather(*endpoint.open)
        await server.wait_closed()
