"""The head of a request, read strictly: at most so large, in one meaning only, and refused as a problem.

The parser below has no limit of its own: a head that never ends would be kept for ever. What it cannot read
(two lengths, a length beside chunks, line breaks within a header) it refuses by itself; here that is put into
the shape that every error has. What stands after a body in chunks is passed over: who may ask, and on which
terms, was settled by then. How long a request may take to come in is told in `patience`; leaves out bodies:
see `edges`.
"""

from __future__ import annotations

from typing import NamedTuple

from service.contract.encode.json import encoded
from service.http.middleware.body_limit import SECURITY_HEADERS
from service.http.middleware.request_timeout import PatientProtocol
from service.problems import MEDIA_TYPE

MOST_BYTES = 65_536
"""Of the address and all headers together."""

_ONCE = frozenset(
    (
        *(b"host", b"content-type", b"content-encoding", b"authorization", b"idempotency-key"),
        *(b"origin", b"sec-fetch-site"),
    )
)
"""Headers that are looked at and are no lists: said twice, they could be taken in two ways."""
_VERSIONS = ("1.0", "1.1")


class Problem(NamedTuple):
    """What is told of a head."""

    status: int
    title: str
    detail: str


# None has a kind of its own: what is asked is not known yet, so no call could document it.
_TOO_LARGE = Problem(
    431,
    "Request Header Fields Too Large",
    f"At most {MOST_BYTES} bytes of address and headers are read here.",
)
_UNREADABLE = Problem(400, "Bad Request", "This is not HTTP as it is read here.")
_NO_HOST = Problem(400, "Bad Request", "The header Host is missing.")
_TWO_NAMES = Problem(400, "Bad Request", "The address names another host than the header Host.")
_TOO_SLOW = Problem(
    408, "Request Timeout", "The request did not come in to its end in time. Nothing was done."
)


def _twice(name: bytes) -> Problem:
    said = "-".join(part.capitalize() for part in name.decode("ascii").split("-"))
    return Problem(400, "Bad Request", f"The header {said} is there more than once.")


class _RefusedError(Exception):
    """Stops the parser."""


class StrictHead(PatientProtocol):
    """One connection."""

    _in_head = False
    _bytes = 0
    _waiting = 0
    """bytes of a head that is not yet complete"""
    _said: frozenset[bytes] = frozenset()
    """of the headers that may be there once, those that were"""
    _host = b""
    _why = _UNREADABLE

    def data_received(self, data: bytes) -> None:
        """Some bytes, of a head or a body or both."""
        before = self._in_head
        super().data_received(data)
        self._waiting = self._waiting + len(data) if before and self._in_head else 0
        if self._waiting > MOST_BYTES and not self.transport.is_closing():
            self._refuse(_TOO_LARGE)

    def on_message_begin(self) -> None:
        """A head begins."""
        self._in_head, self._bytes, self._said, self._why = True, 0, frozenset(), _UNREADABLE
        super().on_message_begin()

    def on_url(self, url: bytes) -> None:
        """A part of its address."""
        self._count(len(url))
        super().on_url(url)

    def on_header(self, name: bytes, value: bytes) -> None:
        """One header, or what stands after a body as one."""
        self._count(len(name) + len(value))
        if not self._in_head:
            return
        low = name.lower()
        if low in _ONCE:
            if low in self._said:
                self._stop(_twice(low))
            self._said |= {low}
            if low == b"host":
                self._host = value
        super().on_header(name, value)

    def on_headers_complete(self) -> None:
        """It ends."""
        self._in_head = False
        version = self.parser.get_http_version()
        if version not in _VERSIONS:
            self._stop(_UNREADABLE)
        if b"host" not in self._said and version == "1.1":
            self._stop(_NO_HOST)
        if not self.url.startswith(b"/") and _named(self.url) not in (None, self._host.lower()):
            self._stop(_TWO_NAMES)
        super().on_headers_complete()

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002
        """What cannot be read, or was refused above."""
        self._refuse(self._why)

    def out_of_patience(self) -> None:
        """A part of a request came, and its end did not."""
        if self._in_head or not self.cycle.response_started:
            self._refuse(_TOO_SLOW)
        else:
            self.transport.close()

    def _count(self, size: int) -> None:
        self._bytes += size
        if self._bytes > MOST_BYTES:
            self._stop(_TOO_LARGE)

    def _stop(self, why: Problem) -> None:
        self._why = why
        raise _RefusedError

    def _refuse(self, problem: Problem) -> None:
        self.transport.write(answered(problem))
        self.transport.close()


def answered(problem: Problem, **more: str) -> bytes:
    """A problem as bytes on a line that is closed after it."""
    body = encoded({"type": "about:blank", **problem._asdict()})
    headers = {
        **SECURITY_HEADERS,
        **{name.replace("_", "-"): value for name, value in more.items()},
        "Content-Type": MEDIA_TYPE,
        "Content-Length": str(len(body)),
        "Connection": "close",
    }
    lines = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
    return f"HTTP/1.1 {problem.status} {problem.title}\r\n{lines}\r\n".encode() + body


def _named(url: bytes) -> bytes | None:
    """The host that an address names by itself, as proxies are asked; None where it names none."""
    _, scheme, rest = url.partition(b"://")
    return rest.partition(b"/")[0].partition(b"?")[0].lower() if scheme else None
