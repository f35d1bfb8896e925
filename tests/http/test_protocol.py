"""Requests as no client library sends them: in part, in two meanings, packed, slowly, on a half-shut line.

What is refused because it is no request at all is in `test_hostile_list`.
"""

from __future__ import annotations

import asyncio
import gzip
import json
from collections.abc import AsyncIterator
from contextlib import suppress
from dataclasses import dataclass

import httpx
import pytest
import websockets.asyncio.client as sockets

from service.app import create_app
from service.http.protocol.header_limits import StrictHttpProtocol
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running

SESSIONS = "/api/v1/sessions"
FIVE = b'{"text":"add five potholes"}'
PACKED = "Send the body as it is, not packed as gzip."
NOT_UTF8 = "The body cannot be read as JSON: it is not written in UTF-8."


@dataclass(frozen=True)
class At:
    """A running service, and one session in it."""

    service: Running
    path: str

    async def sequence(self) -> int:
        async with httpx.AsyncClient(base_url=self.service.http, timeout=60) as client:
            answer = await client.get(self.path)
        assert answer.status_code == 200
        return int(answer.json()["sequence"])

    def head(self, method: str, path: str, *lines: str) -> bytes:
        """A head; the path is that of a part of the session."""
        host = f"Host: 127.0.0.1:{self.service.port}"
        told = [f"{method} {self.path}{path} HTTP/1.1", host, "Content-Type: application/json", *lines]
        return "\r\n".join([*told, "", ""]).encode()

    def said(self, *lines: str, body: bytes = FIVE) -> bytes:
        """A whole request that says something."""
        return self.head("POST", "/commands", f"Content-Length: {len(body)}", *lines) + body


@pytest.fixture
async def at() -> AsyncIterator[At]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        made = await client.post(SESSIONS, json={"seed": 7, "paused": True})
        yield At(service, made.headers["location"])


async def sent(at: At, content: bytes, *, shut: bool = False) -> tuple[int, httpx.Headers, bytes]:
    """Send bytes and read the first answer, or to the line's end where there is none (a status of 0)."""
    reader, writer = await asyncio.open_connection("127.0.0.1", at.service.port)
    try:
        writer.write(content)
        await writer.drain()
        if shut:
            writer.write_eof()
        head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), 60)
        lines = head.decode("latin-1").strip().split("\r\n")
        headers = httpx.Headers([line.split(": ", 1) for line in lines[1:]])
        body = await asyncio.wait_for(reader.readexactly(int(headers.get("content-length", 0))), 60)
    except (asyncio.IncompleteReadError, ConnectionError):
        return 0, httpx.Headers(), b""
    finally:
        writer.close()
        with suppress(ConnectionError):
            await writer.wait_closed()
    return int(lines[0].split()[1]), headers, body


@pytest.mark.parametrize("shut", [False, True], ids=["gone", "half shut"])
@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("POST", "/commands", FIVE),
        ("POST", "/actions", b'{"actions":[{"do":"add","kind":"pothole","count":5}]}'),
        ("POST", "/forks", b"{}"),
        ("PATCH", "/config", b'{"planner":"astar"}'),
        ("DELETE", "", b""),
    ],
)
async def test_a_request_that_came_in_part_is_not_done(
    at: At, method: str, path: str, body: bytes, shut: bool
) -> None:
    """Also where what came can be read: the rest might have said something else."""
    content = at.head(method, path, f"Content-Length: {len(body) + 1}") + body
    if shut:
        assert (await sent(at, content, shut=True))[0] == 0
    else:
        _, writer = await asyncio.open_connection("127.0.0.1", at.service.port)
        writer.write(content)
        await writer.drain()
        writer.close()
        await writer.wait_closed()
    # Answered after the line above was seen to be shut: one loop serves both.
    assert await at.sequence() == 0
    async with httpx.AsyncClient(base_url=at.service.http, timeout=60) as client:
        assert len((await client.get(SESSIONS)).json()["items"]) == 1


async def test_chunks_without_their_end_are_not_done(at: At) -> None:
    head = at.head("POST", "/commands", "Transfer-Encoding: chunked")
    assert (await sent(at, head + b"%x\r\n%b\r\n" % (len(FIVE), FIVE), shut=True))[0] == 0
    assert await at.sequence() == 0


async def test_whoever_shuts_its_half_of_the_line_is_answered(at: At) -> None:
    """`nc -N`: else it would be done, and nobody told."""
    status, _, body = await sent(at, at.said(), shut=True)
    assert (status, json.loads(body)["sequence"]) == (200, 1)


async def test_what_stands_after_a_body_is_no_header(at: At) -> None:
    """A trailer comes when who may ask, and on which terms, is settled."""
    chunks = b'%x\r\n%b\r\n0\r\nIf-Match: "9"\r\nIdempotency-Key: late\r\n\r\n' % (len(FIVE), FIVE)
    for _ in range(2):
        status, headers, _ = await sent(
            at, at.head("POST", "/commands", "Transfer-Encoding: chunked") + chunks
        )
        assert (status, headers.get("idempotency-replayed")) == (200, None)
    assert await at.sequence() == 2


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("Content-Type: text/plain", "The header Content-Type is there more than once."),
        ("Host: 127.0.0.1", "The header Host is there more than once."),
    ],
)
async def test_a_header_that_can_be_taken_in_two_ways_is_refused(at: At, line: str, said: str) -> None:
    status, _, body = await sent(at, at.said(line))
    assert (status, json.loads(body)["detail"]) == (400, said)
    assert await at.sequence() == 0


@pytest.mark.parametrize("name", ["Idempotency-Key", "Authorization", "Origin"])
async def test_and_so_is_what_may_be_there_once(at: At, name: str) -> None:
    status, _, body = await sent(at, at.said(f"{name}: a", f"{name.lower()}: b"))
    assert (status, json.loads(body)["detail"]) == (400, f"The header {name} is there more than once.")


async def test_a_list_on_several_lines_is_one_list(at: At) -> None:
    assert (await sent(at, at.said('If-Match: "7"', 'If-Match: "0"')))[0] == 200
    assert (await sent(at, at.said('If-Match: "7"', 'If-Match: "0"')))[0] == 412
    status, headers, _ = await sent(at, at.head("GET", "/state"))
    lines = ('If-None-Match: "x"', f"If-None-Match: {headers['etag']}")
    assert (status, (await sent(at, at.head("GET", "/state", *lines)))[0]) == (200, 304)


@pytest.mark.parametrize(
    ("target", "status"),
    [
        ("http://127.0.0.1:{port}{path}", 200),
        ("HTTP://127.0.0.1:{port}{path}", 200),
        ("http://evil.example{path}", 400),
        ("http://evil.example?{path}", 400),
        ("http://127.0.0.1:{port}@evil.example{path}", 400),
    ],
)
async def test_an_address_and_host_must_name_the_same(at: At, target: str, status: int) -> None:
    whole = target.format(port=at.service.port, path=at.path)
    content = f"GET {whole} HTTP/1.1\r\nHost: 127.0.0.1:{at.service.port}\r\n\r\n"
    assert (await sent(at, content.encode()))[0] == status


async def test_a_request_without_a_version_is_refused(at: At) -> None:
    """HTTP/0.9 has neither headers nor a status."""
    assert (await sent(at, f"GET {at.path}\r\n\r\n".encode()))[0] == 400


@pytest.mark.parametrize(
    ("lines", "body", "status", "said"),
    [
        (
            ["Content-Encoding: gzip"],
            gzip.compress(FIVE, mtime=0),
            415,
            PACKED,
        ),
        (["Content-Encoding: gzip"], FIVE, 415, PACKED),
        (["Content-Encoding: identity"], FIVE, 200, None),
        ([], gzip.compress(FIVE, mtime=0), 400, NOT_UTF8),
        ([], '{"text":"stra\u00dfe"}'.encode("latin-1"), 400, NOT_UTF8),
    ],
)
async def test_a_body_is_read_as_it_is(
    at: At, lines: list[str], body: bytes, status: int, said: str | None
) -> None:
    answered, headers, told = await sent(at, at.said(*lines, body=body))
    assert (answered, json.loads(told).get("detail")) == (status, said)
    assert headers.get("accept-encoding") == ("identity" if status == 415 else None)
    assert await at.sequence() == (status == 200)


@pytest.mark.parametrize(
    ("kind", "status"),
    [
        ("application/json; charset=utf-8", 200),
        ('application/json;charset="UTF-8"', 200),
        ("application/json; charset=utf-16", 415),
        ("application/json; charset=iso-8859-1", 415),
    ],
)
async def test_a_body_in_other_letters_is_refused(at: At, kind: str, status: int) -> None:
    async with httpx.AsyncClient(base_url=at.service.http, timeout=60) as client:
        headers = {"content-type": kind}
        answer = await client.post(f"{at.path}/commands", content=FIVE, headers=headers)
    assert answer.status_code == status
    if status == 415:
        assert answer.json()["detail"] == f"Send the body in UTF-8, not in {kind.partition('=')[2]}."


def held(at: At) -> list[StrictHttpProtocol]:
    """The lines on which the rest of a request is waited for, until a time."""
    lines = [
        each for each in at.service.server.server_state.connections if isinstance(each, StrictHttpProtocol)
    ]
    return [each for each in lines if each._timer is not None]


async def begun(at: At, *, in_request: bool) -> StrictHttpProtocol:
    """The line on which something is waited for, once the service has seen it."""
    while True:
        for line in held(at):
            if line._in_request == in_request:
                return line
        await at.sequence()


@pytest.mark.parametrize(
    ("part", "told"),
    [
        (b"", 0),
        (b"\r\n", 0),
        (b"GET /healthz HTT", 408),
        (b"GET /healthz HTTP/1.1\r\nHost: 127", 408),
        (b"POST /api/v1/parse HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9\r\n\r\n{", 408),
    ],
)
async def test_nobody_holds_a_line_with_a_part_of_a_request(at: At, part: bytes, told: int) -> None:
    answer = asyncio.create_task(sent(at, part))
    line = await begun(at, in_request=told != 0)
    line._on_timeout()
    status, headers, body = await answer
    assert status == told
    if told:
        assert headers["content-type"] == "application/problem+json"
        assert (
            json.loads(body)["detail"] == "The request did not come in to its end in time. Nothing was done."
        )
    assert await at.sequence() == 0
    assert held(at) == []


async def test_a_byte_now_and_then_gains_no_time(at: At) -> None:
    _, writer = await asyncio.open_connection("127.0.0.1", at.service.port)
    ends = set()
    for part in (b"GET ", b"/healthz ", b"HTTP/1.1\r\n", b"X: 1\r\n"):
        writer.write(part)
        await writer.drain()
        line = await begun(at, in_request=True)
        assert line._timer is not None
        ends.add(line._timer.when())
    writer.close()
    assert len(ends) == 1


async def test_who_waits_for_us_is_not_hurried(at: At) -> None:
    """Neither a line between two requests, nor a socket, nor a stream of events."""
    async with (
        sockets.connect(f"{at.service.ws}{at.path}/stream") as socket,
        httpx.AsyncClient(base_url=at.service.http, timeout=60) as client,
        client.stream("GET", f"{at.path}/events/stream") as events,
    ):
        assert json.loads(await socket.recv())["type"] == "hello"
        assert (await client.get(at.path)).status_code == 200
        assert events.status_code == 200
        await socket.send('{"type":"ping"}')
        assert json.loads(await socket.recv())["type"] == "pong"
        assert held(at) == []
