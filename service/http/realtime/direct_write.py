"""Ready messages written straight to the sockets of a stream, past the task that writes to each.

A tick's message takes next to no time to send; waking a task for it, and passing it on through four layers
that each look at it, took longer than the simulation. Who keeps up is therefore written to at once, as one
frame. Who does not (the socket's own buffer is full, a message is under way) is left to its task as
before: `Straight` answers false then and nothing was sent. A server of another kind offers nothing here, and
all goes through tasks.

Leaves out what a message is, and compression, which the service does not offer.
"""

from __future__ import annotations

from collections.abc import Callable
from struct import Struct
from typing import Final, TypeAlias

from starlette.types import Scope
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.protocol import OPEN

EXTENSION: Final = "roadtalk.straight"
"""Where a connection's scope offers it."""

Straight: TypeAlias = Callable[[bytes], bool]
"""Sends a whole text message now, or answers false."""

_WHOLE_TEXT: Final = 0x81
_SMALL: Final = 126
_MEDIUM: Final = 65_536
_SMALL_HEAD: Final = Struct(">BB").pack
_MEDIUM_HEAD: Final = Struct(">BBH").pack
_LARGE_HEAD: Final = Struct(">BBQ").pack

# What is asked of the server's protocol beyond its documented face; a version without it gets no offer.
_LOOKED_AT: Final = ("conn", "writable", "transport")


def framed(text: bytes) -> bytes:
    """A text message as the one frame that a server sends (RFC 6455): whole, and not masked."""
    size = len(text)
    if size < _SMALL:
        return _SMALL_HEAD(_WHOLE_TEXT, size) + text
    if size < _MEDIUM:
        return _MEDIUM_HEAD(_WHOLE_TEXT, 126, size) + text
    return _LARGE_HEAD(_WHOLE_TEXT, 127, size) + text


def straight_of(scope: Scope) -> Straight | None:
    """What a connection offers, if its server does."""
    found: Straight | None = (scope.get("extensions") or {}).get(EXTENSION)
    return found


class StraightProtocol(WebSocketsSansIOProtocol):
    """The server's own WebSocket, with this offer in its scope."""

    async def run_asgi(self) -> None:
        """See the server's: the application for one connection."""
        if all(hasattr(self, name) for name in _LOOKED_AT):
            extensions: dict[str, object] = self.scope["extensions"]  # type: ignore[assignment]
            extensions[EXTENSION] = self._straight
        await super().run_asgi()

    def _straight(self, text: bytes) -> bool:
        # Open is only what was accepted, and what neither side has begun to close.
        if self.conn.state is not OPEN or not self.writable.is_set() or self.transport.is_closing():
            return False
        self.transport.write(framed(text))
        return True
