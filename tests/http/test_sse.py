"""Server-sent events through a real server: the stream's messages, resumed where they were lost."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import Any

import httpx
import pytest
from websockets.asyncio.client import connect

from service.app import create_app
from service.sessions.subscribers import QUEUE_SIZE, Subscribers
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running

Json = dict[str, Any]


@dataclass
class Event:
    """One event as it came."""

    id: str | None
    name: str
    data: Json


class Reader:
    """Reads events one at a time."""

    def __init__(self, answer: httpx.Response) -> None:
        self.answer = answer
        self._lines = answer.aiter_lines()

    async def next(self) -> Event:
        return await asyncio.wait_for(self._next(), 60)

    async def ended(self) -> bool:
        async with asyncio.timeout(60):
            return [line async for line in self._lines if line] == []

    async def _next(self) -> Event:
        fields: dict[str, str] = {}
        async for line in self._lines:
            if line:
                name, _, value = line.partition(": ")
                fields[name] = value
            elif "data" in fields:
                return Event(fields.get("id"), fields["event"], json.loads(fields["data"]))
            else:
                fields.clear()  # a comment, or how long to wait
        raise AssertionError("the stream ended")


@dataclass
class Live:
    """A running service, a clock moved by hand, and one session."""

    service: Running
    clock: HandClock
    client: httpx.AsyncClient
    path: str
    app: Any

    @asynccontextmanager
    async def read(self, **more: Any) -> AsyncIterator[Reader]:
        async with self.client.stream("GET", f"{self.path}/events/stream", **more) as answer:
            yield Reader(answer)

    async def watched(self, count: int) -> None:
        """Waits until so many watch."""
        async with asyncio.timeout(60):
            while self.app.state.context.manager.subscriber_count != count:  # noqa: ASYNC110 -- nothing tells of it
                await asyncio.sleep(0)


@pytest.fixture
async def live() -> AsyncIterator[Live]:
    settings, clock = Settings(database="memory:"), HandClock()
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=clock)
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        made = await client.post("/api/v1/sessions", json={"seed": 5, "config": {"rows": 10}})
        yield Live(service, clock, client, made.headers["location"], app)


async def test_it_tells_what_the_socket_tells(live: Live) -> None:
    async with connect(f"{live.service.ws}{live.path}/stream") as socket, live.read() as reader:
        assert reader.answer.status_code == 200
        assert reader.answer.headers["content-type"].startswith("text/event-stream")
        events = [await reader.next()]
        told = [json.loads(await socket.recv())]
        live.clock.tick(2)
        await live.client.post(f"{live.path}/commands", json={"text": "add five potholes"})
        live.clock.tick()
        events += [await reader.next() for _ in range(4)]
        told += [json.loads(await asyncio.wait_for(socket.recv(), 60)) for _ in range(4)]
    assert [event.name for event in events] == ["hello", "tick", "tick", "changed", "tick"]
    # Each is told how many watch as it comes: one of them is the second.
    assert {first["session"].pop("watchers") for first in (events[0].data, told[0])} == {1, 2}
    assert [event.data for event in events] == told
    assert [event.id for event in events] == [message["event"] for message in told]
    assert len({event.id for event in events}) == 5
    await live.watched(0)


@pytest.mark.parametrize("how", ["header", "query"])
async def test_whoever_comes_back_is_told_what_it_missed_and_no_more(live: Live, how: str) -> None:
    async with live.read() as reader:
        await reader.next()
        live.clock.tick()
        seen = await reader.next()
    await live.watched(0)
    live.clock.tick(3)
    assert seen.id is not None
    more = {"headers": {"Last-Event-ID": seen.id}} if how == "header" else {"params": {"after": seen.id}}
    async with live.read(**more) as reader:
        missed = [await reader.next() for _ in range(3)]
        assert [event.data["tick"] for event in missed] == [2, 3, 4]
        live.clock.tick()
        assert (await reader.next()).data["tick"] == 5


async def test_the_socket_resumes_as_well(live: Live) -> None:
    async with connect(f"{live.service.ws}{live.path}/stream") as socket:
        last = json.loads(await socket.recv())["event"]
    await live.watched(0)
    live.clock.tick(2)
    async with connect(f"{live.service.ws}{live.path}/stream?after={last}") as socket:
        told = [json.loads(await asyncio.wait_for(socket.recv(), 60)) for _ in range(2)]
        assert [(each["type"], each["tick"]) for each in told] == [("tick", 1), ("tick", 2)]
    async with connect(f"{live.service.ws}{live.path}/stream?after=3") as socket:
        assert json.loads(await asyncio.wait_for(socket.recv(), 60))["type"] == "hello"


@pytest.mark.parametrize("said", ["", "nonsense", "abc.1", ".", "x" * 100])
async def test_an_id_that_is_not_kept_begins_anew(live: Live, said: str) -> None:
    async with live.read(headers={"Last-Event-ID": said}) as reader:
        assert (await reader.next()).name == "hello"


async def test_what_was_missed_too_long_ago_begins_anew(live: Live) -> None:
    async with live.read() as reader:
        seen = await reader.next()
    await live.watched(0)
    live.clock.tick(QUEUE_SIZE + 1)
    async with live.read(headers={"Last-Event-ID": str(seen.id)}) as reader:
        first = await reader.next()
    assert (first.name, first.data["state"]["tick"]) == ("hello", QUEUE_SIZE + 1)


async def test_a_slow_reader_is_told_what_it_missed(live: Live) -> None:
    async with live.read() as reader:
        await reader.next()
        live.clock.tick(QUEUE_SIZE + 5)
        state = await reader.next()
        assert (state.name, state.data["missed"]) == ("state", [1, QUEUE_SIZE + 5])
        assert state.data["state"]["tick"] == QUEUE_SIZE + 5
        live.clock.tick()
        after = await reader.next()
        assert (after.name, after.data["tick"]) == ("tick", QUEUE_SIZE + 6)
    async with live.read(headers={"Last-Event-ID": str(state.id)}) as reader:
        assert (await reader.next()).id == after.id


async def test_a_deleted_session_is_the_end(live: Live) -> None:
    async with live.read() as reader:
        await reader.next()
        await live.client.delete(live.path)
        assert (await reader.next()).name == "gone"
        assert await reader.ended()


async def test_a_service_that_stops_says_so_and_waits_for_no_reader(live: Live) -> None:
    async with live.read() as reader:
        await reader.next()
        async with asyncio.timeout(60):
            stopping = asyncio.create_task(live.service.stop())
            last = await reader.next()
            assert (last.name, last.data["code"]) == ("stopping", 1012)
            assert await reader.ended()
            await stopping


async def test_refusals_are_problems(live: Live) -> None:
    unknown = await live.client.get("/api/v1/sessions/nobody/events/stream")
    assert (unknown.status_code, unknown.headers["content-type"]) == (404, "application/problem+json")
    long = await live.client.get(f"{live.path}/events/stream", headers={"Last-Event-ID": "x" * 101})
    assert (long.status_code, long.json()["type"]) == (422, "/problems/invalid")
    assert live.app.state.context.manager.subscriber_count == 0


def test_nothing_is_kept_where_nobody_watches() -> None:
    subscribers, made = Subscribers(), 0

    def message() -> bytes:
        nonlocal made
        made += 1
        return b"{}"

    for tick in range(50):
        subscribers.publish(tick, message)
    assert made == 0
    subscribers.unsubscribe(subscribers.subscribe())
    event = subscribers.last_event_id
    for tick in range(50):
        subscribers.publish(tick, message)
        missed = subscribers.messages_since(event)
        assert (missed is None) == (tick >= QUEUE_SIZE)
        assert missed is None or [notice.tick for notice in missed] == list(range(tick + 1))
    assert made == QUEUE_SIZE
    assert subscribers.messages_since(subscribers.last_event_id) == []
