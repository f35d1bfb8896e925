"""Stream messages written straight to the transport of a WebSocket, past the task that sends.

Sending a tick takes next to no time; waking a task for it, and passing it through four layers, took longer
than the simulation (`python -m bench.live`, processor time of a tick). A client that keeps up is therefore
written to at once, one frame a message. For a client that does not (its buffer is full, a message is under
way), the call returns false and sends nothing: the message goes through the task.

Not handled: compression, which the service does not offer.
"""

from __future__ import annotations

from struct import Struct
from typing import Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.protocol import OPEN

from service.http.realtime.direct_write import EXTENSION

_WHOLE_TEXT: Final = 0x81
_SMALL: Final = 126
_MEDIUM: Final = 65_536
_SMALL_HEAD: Final = Struct(">BB").pack
_MEDIUM_HEAD: Final = Struct(">BBH").pack
_LARGE_HEAD: Final = Struct(">BBQ").pack


def encode_frame(text: bytes) -> bytes:
    """A text message as the one frame that a server sends (RFC 6455): final, and not masked."""
    size = len(text)
    if size < _SMALL:
        return _SMALL_HEAD(_WHOLE_TEXT, size) + text
    if size < _MEDIUM:
        return _MEDIUM_HEAD(_WHOLE_TEXT, 126, size) + text
    return _LARGE_HEAD(_WHOLE_TEXT, 127, size) + text


class DirectWriteProtocol(WebSocketsSansIOProtocol):
    """uvicorn's WebSocket connection, with the offer in its scope."""

    async def run_asgi(self) -> None:
        """Runs the application of one connection."""
        extensions: dict[str, object] = self.scope["extensions"]  # type: ignore[assignment]
        extensions[EXTENSION] = self._write_directly
        await super().run_asgi()

    def _write_directly(self, text: bytes) -> bool:
        # Open means accepted, and not being closed from either side.
        if self.conn.state is not OPEN or not self.writable.is_set() or self.transport.is_closing():
            return False
        self.transport.write(encode_frame(text))
        return True
