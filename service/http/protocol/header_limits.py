"""Strict headers: a size limit, no header that could be read in two ways, and refusals as problem documents.

httptools has no limit of its own: a head that never ends would be kept for ever. What it refuses by itself
(two lengths, a length beside chunks, line breaks within a header), uvicorn answers in plain text; here it
gets the shape of every other error. Trailers after a chunked body are ignored: access was checked before
them. `request_timeout` limits the time, `service.http.body_limit` the body.
"""

from __future__ import annotations

from typing import NamedTuple

from service.contract.encode.json import encoded
from service.http.middleware.security_headers import SECURITY_HEADERS
from service.http.protocol import MAX_HEADER_BYTES
from service.http.protocol.request_timeout import TimeoutProtocol
from service.problems import MEDIA_TYPE

_SINGLE = frozenset(
    (
        *(b"host", b"content-type", b"content-encoding", b"authorization", b"idempotency-key"),
        *(b"origin", b"sec-fetch-site"),
    )
)
"""Headers that decide something and are no lists: sent twice, they could be read in two ways."""
_VERSIONS = ("1.0", "1.1")


class ProtocolProblem(NamedTuple):
    """A problem of a request that has not been parsed; its type is `about:blank`, since no call is known."""

    status: int
    title: str
    detail: str


_TOO_LARGE = ProtocolProblem(
    431,
    "Request Header Fields Too Large",
    f"At most {MAX_HEADER_BYTES} bytes of address and headers are read here.",
)
_UNREADABLE = ProtocolProblem(400, "Bad Request", "This is not HTTP as it is read here.")
_NO_HOST = ProtocolProblem(400, "Bad Request", "The header Host is missing.")
_TWO_NAMES = ProtocolProblem(400, "Bad Request", "The address names another host than the header Host.")
_TIMEOUT = ProtocolProblem(
    408, "Request Timeout", "The request did not come in to its end in time. Nothing was done."
)


def _duplicate(name: bytes) -> ProtocolProblem:
    shown = "-".join(part.capitalize() for part in name.decode("ascii").split("-"))
    return ProtocolProblem(400, "Bad Request", f"The header {shown} is there more than once.")


class _RefusedError(Exception):
    """Stops the parser."""


class StrictHttpProtocol(TimeoutProtocol):
    """One HTTP connection with strict headers."""

    _in_head = False
    _bytes = 0
    _unparsed = 0
    """bytes of a head that is not yet complete"""
    _seen: frozenset[bytes] = frozenset()
    """those of `_SINGLE` that this request has sent"""
    _host = b""
    _refusal = _UNREADABLE

    def data_received(self, data: bytes) -> None:
        """Feeds the parser and limits what it holds back."""
        before = self._in_head
        super().data_received(data)
        self._unparsed = self._unparsed + len(data) if before and self._in_head else 0
        if self._unparsed > MAX_HEADER_BYTES and not self.transport.is_closing():
            self._refuse(_TOO_LARGE)

    def on_message_begin(self) -> None:
        """Handles the beginning of a head."""
        self._in_head, self._bytes, self._seen, self._refusal = True, 0, frozenset(), _UNREADABLE
        super().on_message_begin()

    def on_url(self, url: bytes) -> None:
        """Handles a part of the address."""
        self._count(len(url))
        super().on_url(url)

    def on_header(self, name: bytes, value: bytes) -> None:
        """Handles a header, or a trailer, which is ignored."""
        self._count(len(name) + len(value))
        if not self._in_head:
            return
        lower = name.lower()
        if lower in _SINGLE:
            if lower in self._seen:
                self._stop(_duplicate(lower))
            self._seen |= {lower}
            if lower == b"host":
                self._host = value
        super().on_header(name, value)

    def on_headers_complete(self) -> None:
        """Checks version and host."""
        self._in_head = False
        version = self.parser.get_http_version()
        if version not in _VERSIONS:
            self._stop(_UNREADABLE)
        if b"host" not in self._seen and version == "1.1":
            self._stop(_NO_HOST)
        if not self.url.startswith(b"/") and _absolute_host(self.url) not in (None, self._host.lower()):
            self._stop(_TWO_NAMES)
        super().on_headers_complete()

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002
        """Answers what the parser cannot read, or what was refused above."""
        self._refuse(self._refusal)

    def request_timed_out(self) -> None:
        """Answers an incomplete request, unless an answer has begun."""
        if self._in_head or not self.cycle.response_started:
            self._refuse(_TIMEOUT)
        else:
            self.transport.close()

    def _count(self, size: int) -> None:
        self._bytes += size
        if self._bytes > MAX_HEADER_BYTES:
            self._stop(_TOO_LARGE)

    def _stop(self, problem: ProtocolProblem) -> None:
        self._refusal = problem
        raise _RefusedError

    def _refuse(self, problem: ProtocolProblem) -> None:
        self.transport.write(raw_response(problem))
        self.transport.close()


def raw_response(problem: ProtocolProblem, **headers: str) -> bytes:
    """A problem as the bytes of a response that closes the connection; `_` in a header is `-`."""
    body = encoded({"type": "about:blank", **problem._asdict()})
    every = {
        **SECURITY_HEADERS,
        **{name.replace("_", "-"): value for name, value in headers.items()},
        "Content-Type": MEDIA_TYPE,
        "Content-Length": str(len(body)),
        "Connection": "close",
    }
    lines = "".join(f"{name}: {value}\r\n" for name, value in every.items())
    return f"HTTP/1.1 {problem.status} {problem.title}\r\n{lines}\r\n".encode() + body


def _absolute_host(url: bytes) -> bytes | None:
    """The host of an absolute address, as proxies are asked; None for a path."""
    _, scheme, rest = url.partition(b"://")
    return rest.partition(b"/")[0].partition(b"?")[0].lower() if scheme else None
