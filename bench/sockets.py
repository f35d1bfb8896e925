"""Sockets for measuring with: as little as a watcher can be, so that thousands fit beside the service.

A client library spends more on a message than the service does. Here a message is cut out of its frame and
handed on; pings are answered, and nothing else is understood.
"""

from __future__ import annotations

import asyncio
import base64
import os
from collections.abc import Callable

_TEXT, _BINARY, _CLOSE, _PING, _PONG = 1, 2, 8, 9, 10
_MASK = b"\0\0\0\0"
"""Clients have to mask; with zeros that changes nothing."""


class Socket(asyncio.Protocol):
    """One WebSocket; `heard` is given each message."""

    def __init__(self, path: str, host: str, heard: Callable[[bytes], None]) -> None:
        """Open with `opened`."""
        self._request = (
            f"GET {path} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}\r\n"
            "Sec-WebSocket-Version: 13\r\n\r\n"
        )
        self._heard = heard
        self._buffer = b""
        self._transport: asyncio.Transport | None = None
        self.upgraded = asyncio.Event()
        self.ended = asyncio.Event()
        self.code: int | None = None
        """the code it was closed with"""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Ask for the upgrade."""
        assert isinstance(transport, asyncio.Transport) or hasattr(transport, "write")
        self._transport = transport  # type: ignore[assignment]
        self.raw(self._request.encode())

    def data_received(self, data: bytes) -> None:
        """Cut frames out of what came."""
        buffer = self._buffer + data if self._buffer else data
        if not self.upgraded.is_set():
            head, found, buffer = buffer.partition(b"\r\n\r\n")
            if not found:
                self._buffer = head
                return
            if b" 101 " not in head.partition(b"\r\n")[0]:
                self.close()
                return
            self.upgraded.set()
        while True:
            if len(buffer) < 2:
                break
            size, at = buffer[1], 2
            if size == 126:
                size, at = int.from_bytes(buffer[2:4], "big"), 4
            elif size == 127:
                size, at = int.from_bytes(buffer[2:10], "big"), 10
            if len(buffer) < at + size:
                break
            self._frame(buffer[0] & 15, buffer[at : at + size])
            buffer = buffer[at + size :]
        self._buffer = buffer

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002
        """It is over."""
        self.upgraded.set()
        self.ended.set()

    def say(self, data: bytes) -> None:
        """Send a text message."""
        self._send(_TEXT, data)

    def raw(self, data: bytes) -> None:
        """Send bytes as they are."""
        if self._transport is not None and not self._transport.is_closing():
            self._transport.write(data)

    def stall(self) -> None:
        """Read no more."""
        assert self._transport is not None
        self._transport.pause_reading()

    def close(self) -> None:
        """Go without a word."""
        if self._transport is not None:
            self._transport.abort()

    def _frame(self, kind: int, payload: bytes) -> None:
        if kind in (_TEXT, _BINARY):
            self._heard(payload)
        elif kind == _PING:
            self._send(_PONG, payload)
        elif kind == _CLOSE:
            self.code = int.from_bytes(payload[:2], "big")
            self.close()

    def _send(self, kind: int, data: bytes) -> None:
        size = len(data)
        if size < 126:
            head = bytes((0x80 | kind, 0x80 | size))
        elif size < 65_536:
            head = bytes((0x80 | kind, 0x80 | 126)) + size.to_bytes(2, "big")
        else:
            head = bytes((0x80 | kind, 0x80 | 127)) + size.to_bytes(8, "big")
        self.raw(head + _MASK + data)


async def opened(url: str, path: str, heard: Callable[[bytes], None]) -> Socket:
    """A socket to a path of the service at `url`, once it has been taken."""
    host, _, port = url.removeprefix("http://").partition(":")
    loop = asyncio.get_running_loop()
    _, socket = await loop.create_connection(lambda: Socket(path, f"{host}:{port}", heard), host, int(port))
    await socket.upgraded.wait()
    if socket.ended.is_set():
        raise ConnectionError(f"{path} was refused")
    return socket
