"""Sockets as no client library opens or uses them: always an answer, no failure, nothing piles up."""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import AsyncIterator

import httpx
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from service.app import create_app
from service.http.protocol import websocket as sockets
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running

KEY = "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="
VERSION = "Sec-WebSocket-Version: 13"
PING = b"\x89\xfd" + bytes(4) + b"x" * 125


@pytest.fixture
async def live() -> AsyncIterator[Running]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as service:
        yield service


@pytest.fixture
async def path(live: Running) -> str:
    async with httpx.AsyncClient(base_url=live.http, timeout=60) as client:
        made = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    return f"{made.headers['location']}/stream"


def handshake(live: Running, method: str, path: str, *lines: str) -> bytes:
    host = f"Host: 127.0.0.1:{live.port}"
    head = [f"{method} {path} HTTP/1.1", host, "Upgrade: websocket", "Connection: Upgrade", *lines]
    return "\r\n".join([*head, "", ""]).encode("latin-1")


async def refused(live: Running, content: bytes) -> tuple[int, httpx.Headers, dict[str, object]]:
    """What is answered to its end, on a line that the service closes."""
    reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
    writer.write(content)
    answer = await asyncio.wait_for(reader.read(), 60)
    writer.close()
    head, _, body = answer.partition(b"\r\n\r\n")
    status, *lines = head.decode("latin-1").split("\r\n")
    return int(status.split()[1]), httpx.Headers([line.split(": ", 1) for line in lines]), json.loads(body)


@pytest.mark.parametrize(
    ("method", "lines", "status", "said"),
    [
        ("GET", [VERSION], 400, "missing Sec-WebSocket-Key"),
        ("GET", [VERSION, "Sec-WebSocket-Key: abc"], 400, "invalid Sec-WebSocket-Key"),
        ("GET", [KEY], 426, "Speak version 13"),
        ("GET", [KEY, "Sec-WebSocket-Version: 8"], 426, "Speak version 13"),
        ("GET", [KEY, VERSION, "Content-Length: 2"], 400, ""),
        ("GET", [KEY, VERSION, "Transfer-Encoding: chunked"], 400, ""),
        ("GET", [KEY, VERSION, f"X: {'a' * 20_000}"], 400, ""),
        ("GET", [KEY, VERSION, *(f"X-{number}: 1" for number in range(300))], 400, ""),
        ("POST", [KEY, VERSION], 405, "POST"),
    ],
)
async def test_a_handshake_that_is_none_is_answered(
    live: Running, path: str, method: str, lines: list[str], status: int, said: str
) -> None:
    answered, headers, problem = await refused(live, handshake(live, method, path, *lines))
    assert (answered, problem["status"]) == (status, status)
    assert headers["content-type"] == "application/problem+json"
    assert headers["x-content-type-options"] == "nosniff"
    assert headers.get("sec-websocket-version") == ("13" if status == 426 else None)
    assert said in str(problem["detail"])


async def test_an_address_that_is_too_long_is_answered(live: Running, path: str) -> None:
    content = handshake(live, "GET", f"{path}?after={'a' * 20_000}", KEY, VERSION)
    assert (await refused(live, content))[0] == 400


@pytest.mark.parametrize("address", ["/", "/healthz", "/api/v1/nowhere", "{path}/"])
async def test_where_no_socket_is(
    live: Running, path: str, address: str, caplog: pytest.LogCaptureFixture
) -> None:
    address = address.format(path=path)
    with caplog.at_level(logging.WARNING), pytest.raises(InvalidStatus) as told:
        await connect(f"{live.ws}{address}").__aenter__()
    assert told.value.response.status_code == 404
    assert json.loads(told.value.response.body or b"")["detail"] == (
        f"There is no WebSocket at {address}; a session's is at /api/v1/sessions/{{id}}/stream."
    )
    assert caplog.records == []


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ("aftr=3", "is not known here; did you mean after"),
        ("after=1&after=2", "is there more than once"),
        ("ticket=x", "is not known here, where there are after"),
    ],
)
async def test_a_slip_in_the_address_of_a_socket_is_told(
    live: Running, path: str, asked: str, message: str
) -> None:
    async with connect(f"{live.ws}{path}?{asked}") as socket:
        (error,) = json.loads(await socket.recv())["problem"]["errors"]
        assert error == {"field": asked.partition("=")[0], "message": message}
        with pytest.raises(ConnectionClosed) as closed:
            await socket.recv()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1008


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("{}", "The message has no `type`."),
        ("[]", "The message must be an object."),
        ('{"type":"comand"}', "did you mean command."),
        ('{"type":"command","id":"1","txt":"x"}', "txt: is not a known key; did you mean text."),
    ],
)
async def test_a_message_that_is_none_is_told_so(live: Running, path: str, message: str, said: str) -> None:
    async with connect(f"{live.ws}{path}") as socket:
        await socket.recv()
        await socket.send(message)
        told = json.loads(await socket.recv())
    assert told["type"] == "error"
    assert told["problem"]["detail"].endswith(said)


async def opened(live: Running, path: str) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
    writer.write(handshake(live, "GET", path, KEY, VERSION))
    assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 101")
    return reader, writer


async def test_letters_that_are_none_are_no_failure(
    live: Running, path: str, caplog: pytest.LogCaptureFixture
) -> None:
    reader, writer = await opened(live, path)
    writer.write(b"\x81\x82" + bytes(4) + b"\xff\xfe")
    with caplog.at_level(logging.WARNING):
        rest = await asyncio.wait_for(reader.read(), 60)
    writer.close()
    assert rest.endswith((1007).to_bytes(2, "big") + b"not written in UTF-8")
    assert caplog.records == []


async def test_a_message_of_endless_parts_is_ended(
    live: Running, path: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sockets, "MAX_FRAGMENTS", 10)
    reader, writer = await opened(live, path)
    writer.write(b"\x01\x80" + bytes(4) + (b"\x00\x80" + bytes(4)) * 20)
    rest = await asyncio.wait_for(reader.read(), 60)
    writer.close()
    assert rest.endswith((1009).to_bytes(2, "big") + b"more than 10 fragments")


async def test_pings_that_nobody_reads_the_answers_of_pile_nothing_up(live: Running, path: str) -> None:
    reader, writer = await opened(live, path)
    for _ in range(100):
        writer.write(PING * 400)
        await writer.drain()
    async with connect(f"{live.ws}{path}") as beside:  # read after all that, by the same loop
        await beside.recv()
        held = [each.transport.get_write_buffer_size() for each in live.server.server_state.connections]
        assert max(held) < 500_000  # of 5,000,000 that would have been answered
    writer.close()
    del reader


async def test_whoever_goes_before_the_answer_is_no_failure(
    live: Running, path: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        for _ in range(20):
            _, writer = await opened(live, path)
            said = b'{"type":"command","id":"1","text":"add two cars"}'
            frame = b"\x81" + bytes([0x80 | len(said)]) + bytes(4) + said
            writer.write(frame * 3 + b"\x88\x80" + bytes(4))
            await writer.drain()
            writer.close()
            await writer.wait_closed()
        async with connect(f"{live.ws}{path}") as socket:
            assert json.loads(await socket.recv())["session"]["sequence"] >= 0
    assert [record.getMessage() for record in caplog.records] == []
    with pytest.raises(ConnectionClosed):
        await socket.recv()
