"""What surrounds every call: no more bytes are read than agreed, and headers that keep a browser safe."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http.responses import problem_response
from service.problems import TooLarge

SECURITY_HEADERS = {
    "Content-Security-Policy": (
        "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'; object-src 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


_ENCODED = [(name.lower().encode(), value.encode()) for name, value in SECURITY_HEADERS.items()]
_NAMES = frozenset(name for name, _ in _ENCODED)


def first_header(scope: Scope, asked: bytes) -> str | None:
    """The first header of a request under a name, which is in small letters; None where there is none."""
    for name, value in scope["headers"]:
        if name == asked:
            return str(value, "latin-1")
    return None


class SecurityHeaders:
    """Adds the headers to every HTTP answer that has not set them itself."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        if scope["type"] != "http":
            return self._app(scope, receive, send)

        def guarded(message: Message) -> Awaitable[None]:
            if message["type"] == "http.response.start":
                headers = message["headers"]
                said = {name for name, _ in headers}
                missing = (
                    _ENCODED
                    if _NAMES.isdisjoint(said)
                    else [each for each in _ENCODED if each[0] not in said]
                )
                message["headers"] = [*headers, *missing]
            return send(message)

        return self._app(scope, receive, guarded)


class BodyLimit:
    """Reads a body up to its limit before anyone else does; a larger one is refused unread.

    The framework's own limit answers in plain text, which would be the one error here that is no
    problem document. Whoever goes away before the whole of it was sent has asked for nothing: what came may
    be readable by itself, and mean something else.
    """

    def __init__(self, app: ASGIApp, most: Callable[[str], int]) -> None:
        """`most` answers how many bytes a path may be sent."""
        self._app = app
        self._most = most

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        if scope["type"] != "http" or scope["method"] in ("GET", "HEAD"):
            return self._app(scope, receive, send)
        return self._limited(scope, receive, send)

    async def _limited(self, scope: Scope, receive: Receive, send: Send) -> None:
        most = self._most(scope["path"])
        said = first_header(scope, b"content-length") or ""
        try:
            body = None if said.isdecimal() and int(said) > most else await _read(receive, most)
        except ClientDisconnect:
            return
        if body is None:
            refusal = TooLarge(f"At most {most} bytes are read here.", headers={"Connection": "close"})
            await problem_response(refusal)(scope, receive, send)
            return
        waiting: list[Message] = [{"type": "http.request", "body": body, "more_body": False}]

        async def replay() -> Message:
            return waiting.pop() if waiting else await receive()

        await self._app(scope, replay, send)


async def _read(receive: Receive, most: int) -> bytes | None:
    """The whole body, or None once it is more than `most` bytes. Raises `ClientDisconnect` before its end."""
    parts: list[bytes] = []
    size = 0
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        part = message.get("body", b"")
        parts.append(part)
        size += len(part)
        if size > most:
            return None
        if not message.get("more_body", False):
            return b"".join(parts)
