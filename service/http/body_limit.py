"""Body limit: reads a request's body before anything looks at it, up to its limit; a larger one is refused.

FastAPI's limit (`max_body_size`) counts while parsing. If a client disconnects midway, the part received
could be valid JSON with another meaning and would be executed.
"""

from __future__ import annotations

from starlette.requests import ClientDisconnect
from starlette.types import Message, Receive, Scope

from service.http.headers import first_header
from service.problems import ContentTooLarge


async def read_body(scope: Scope, receive: Receive, limit: int) -> bytes:
    """The whole body. Raises `ContentTooLarge` (over `limit` bytes) or `ClientDisconnect` (incomplete)."""
    length = first_header(scope, b"content-length") or ""
    if length.isdecimal() and int(length) > limit:
        raise _too_large(limit)
    parts: list[bytes] = []
    size = 0
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        part = message.get("body", b"")
        parts.append(part)
        size += len(part)
        if size > limit:
            raise _too_large(limit)
        if not message.get("more_body", False):
            return b"".join(parts)


def receive_again(body: bytes, receive: Receive) -> Receive:
    """A `receive` that gives the body that was read, then whatever comes after it."""
    waiting: list[Message] = [{"type": "http.request", "body": body, "more_body": False}]

    async def replay() -> Message:
        return waiting.pop() if waiting else await receive()

    return replay


def _too_large(limit: int) -> ContentTooLarge:
    return ContentTooLarge(f"At most {limit} bytes are read here.", headers={"Connection": "close"})
