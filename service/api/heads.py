"""The head of a request, read strictly: at most so large, asked under one name, and refused as a problem.

The parser below has no limit of its own: a head that never ends would be kept for ever. What it cannot read
(two lengths, a length beside chunks, line breaks within a header) it refuses by itself; here that is put into
the shape that every error has. Leaves out bodies: see `edges`.
"""

from __future__ import annotations

from typing import NamedTuple

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from service.api.edges import SECURITY_HEADERS
from service.problems import MEDIA_TYPE
from service.wire.encode import encoded

MOST_BYTES = 65_536
"""Of the address and all headers together."""


class Problem(NamedTuple):
    """What is told of a head."""

    status: int
    title: str
    detail: str


# Neither has a kind of its own: what is asked is not known yet, so no call could document it.
_TOO_LARGE = Problem(
    431,
    "Request Header Fields Too Large",
    f"At most {MOST_BYTES} bytes of address and headers are read here.",
)
_UNREADABLE = Problem(400, "Bad Request", "This is not HTTP as it is read here.")


class _RefusedError(Exception):
    """Stops the parser."""


class StrictHead(HttpToolsProtocol):
    """One connection."""

    _in_head = False
    _bytes = 0
    _waiting = 0
    """bytes of a head that is not yet complete"""
    _hosts = 0

    def data_received(self, data: bytes) -> None:
        """Some bytes, of a head or a body or both."""
        before = self._in_head
        super().data_received(data)
        self._waiting = self._waiting + len(data) if before and self._in_head else 0
        if self._waiting > MOST_BYTES and not self.transport.is_closing():
            self._refuse(_TOO_LARGE)

    def on_message_begin(self) -> None:
        """A head begins."""
        self._in_head, self._bytes, self._hosts = True, 0, 0
        super().on_message_begin()

    def on_url(self, url: bytes) -> None:
        """A part of its address."""
        self._count(len(url))
        super().on_url(url)

    def on_header(self, name: bytes, value: bytes) -> None:
        """One header."""
        self._count(len(name) + len(value))
        self._hosts += name.lower() == b"host"
        super().on_header(name, value)

    def on_headers_complete(self) -> None:
        """It ends."""
        self._in_head = False
        if self._hosts > 1 or (self._hosts == 0 and self.parser.get_http_version() == "1.1"):
            raise _RefusedError  # which of the names was meant can be read in two ways
        super().on_headers_complete()

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002
        """What cannot be read, or was refused above."""
        self._refuse(_TOO_LARGE if self._bytes > MOST_BYTES else _UNREADABLE)

    def _count(self, size: int) -> None:
        self._bytes += size
        if self._bytes > MOST_BYTES:
            raise _RefusedError

    def _refuse(self, problem: Problem) -> None:
        body = encoded({"type": "about:blank", **problem._asdict()})
        headers = {
            **SECURITY_HEADERS,
            "Content-Type": MEDIA_TYPE,
            "Content-Length": str(len(body)),
            "Connection": "close",
        }
        lines = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
        self.transport.write(f"HTTP/1.1 {problem.status} {problem.title}\r\n{lines}\r\n".encode() + body)
        self.transport.close()
