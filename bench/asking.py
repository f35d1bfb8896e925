"""HTTP for measuring with: as little as a client can be, so that what it costs is not what is measured."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from types import TracebackType


@dataclass(frozen=True, slots=True)
class Answer:
    """What came back."""

    status: int
    headers: dict[str, str]
    body: bytes


def request(method: str, path: str, host: str, body: bytes = b"", **headers: str) -> bytes:
    """A request as bytes; names of headers with `_` for `-`."""
    lines = [f"{method} {path} HTTP/1.1", f"Host: {host}"]
    lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
    if body or method in ("POST", "PATCH", "PUT"):
        lines.append(f"Content-Length: {len(body)}")
    return "\r\n".join(lines).encode() + b"\r\n\r\n" + body


class Line:
    """One connection, which is opened anew when the other side has closed it."""

    def __init__(self, url: str) -> None:
        self.host = url.removeprefix("http://")
        self._streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] | None = None

    async def __aenter__(self) -> Line:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.hang_up()

    def hang_up(self) -> None:
        """Close the connection."""
        if self._streams is not None:
            self._streams[1].transport.abort()
            self._streams = None

    async def ask(self, sent: bytes) -> Answer:
        """Send a request and read the answer; an answer of status 0 is none at all."""
        if self._streams is None:
            host, _, port = self.host.partition(":")
            self._streams = await asyncio.open_connection(host, int(port))
        reader, writer = self._streams
        try:
            writer.write(sent)
            answer = await self._read(reader, head=sent.startswith(b"HEAD "))
        except (ConnectionError, asyncio.IncompleteReadError):
            self.hang_up()
            return Answer(0, {}, b"")
        if answer.headers.get("connection", "") == "close":
            self.hang_up()
        return answer

    @staticmethod
    async def _read(reader: asyncio.StreamReader, *, head: bool) -> Answer:
        lines = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").split("\r\n")
        headers = {
            name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])
        }
        status = int(lines[0].split(" ")[1])
        size = 0 if head or status in (204, 304) else int(headers.get("content-length", "0"))
        return Answer(status, headers, await reader.readexactly(size))
