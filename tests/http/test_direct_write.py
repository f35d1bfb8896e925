"""Messages that are written straight: one frame each, in order, and only to who keeps up."""

from __future__ import annotations

import asyncio
import json

import httpx
import pytest
from websockets.asyncio.client import connect
from websockets.frames import Frame, Opcode
from websockets.protocol import State
from websockets.server import ServerProtocol

from service.app import create_app
from service.http.protocol.direct_write import DirectWriteProtocol, encode_frame
from service.http.realtime.direct_write import direct_write_of
from service.sessions.subscribers import QUEUE_SIZE, MissedTicks, Subscriber, Subscribers
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running


@pytest.mark.parametrize("size", [0, 1, 125, 126, 127, 65_535, 65_536, 200_000])
def test_a_frame_is_what_the_library_would_send(size: int) -> None:
    text = b"x" * size
    assert encode_frame(text) == Frame(Opcode.TEXT, text).serialize(mask=False)


def test_a_server_of_another_kind_offers_nothing() -> None:
    assert direct_write_of({"type": "websocket"}) is None
    assert direct_write_of({"type": "websocket", "extensions": {"websocket.http.response": {}}}) is None


class Reader:
    """One who notes all that it is given, straight or in turn."""

    def __init__(self, subscribers: Subscribers) -> None:
        self.takes = True
        self.straight: list[bytes] = []
        self.all: list[bytes | MissedTicks] = []
        self.watcher: Subscriber = subscribers.subscribe((), self.take)

    def take(self, text: bytes) -> bool:
        if self.takes:
            self.straight.append(text)
            self.all.append(text)
        return self.takes

    async def read(self) -> None:
        while True:
            heard = await self.watcher.next()
            if isinstance(heard, list):
                self.all += [notice.data for notice in heard]
            elif isinstance(heard, MissedTicks):
                self.all.append(heard)
            else:
                return


def publish(subscribers: Subscribers, *ticks: int) -> list[bytes]:
    told = [b"%d" % tick for tick in ticks]
    for tick, text in zip(ticks, told, strict=True):
        subscribers.publish(tick, lambda text=text: text)
    return told


async def test_only_who_waits_is_written_to_and_nothing_is_overtaken() -> None:
    subscribers = Subscribers()
    reader = Reader(subscribers)
    first = publish(subscribers, 1, 2)  # it has not begun to wait yet
    reading = asyncio.create_task(reader.read())
    await asyncio.sleep(0)
    assert reader.straight == []
    assert reader.all == first
    second = publish(subscribers, 3, 4)
    assert reader.straight == second
    reader.takes = False
    third = publish(subscribers, 5)
    reader.takes = True
    third += publish(subscribers, 6)  # the one before has not been passed on yet
    assert reader.straight == second
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    fourth = publish(subscribers, 7)
    assert reader.straight == second + fourth
    assert reader.all == first + second + third + fourth
    subscribers.close()
    await asyncio.wait_for(reading, 60)


async def test_who_refuses_all_is_told_what_it_missed() -> None:
    subscribers = Subscribers()
    reader = Reader(subscribers)
    reader.takes = False
    reading = asyncio.create_task(reader.read())
    await asyncio.sleep(0)
    publish(subscribers, *range(1, QUEUE_SIZE + 2))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    assert reader.all == [MissedTicks(1, QUEUE_SIZE + 1)]
    subscribers.close()
    await asyncio.wait_for(reading, 60)


async def test_a_real_socket_is_written_to_straight_and_in_order() -> None:
    settings, clock = Settings(database="memory:"), HandClock()
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=clock)
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        path = (await client.post("/api/v1/sessions", json={"seed": 5})).headers["location"]
        session = await app.state.context.manager.get(path.rpartition("/")[2])
        async with connect(f"{service.ws}{path}/stream", compression=None) as stream:
            hello = json.loads(await stream.recv())
            (subscriber,) = session.subscribers._subscribers
            straight: list[int] = []
            offered = subscriber._straight

            def noting(text: bytes) -> bool:
                taken: bool = offered(text)
                straight.append(json.loads(text)["tick"])
                return taken

            subscriber._straight = noting
            heard = [hello]
            for _ in range(5):
                clock.tick()
                heard.append(json.loads(await stream.recv()))
            ticks = [message["tick"] for message in heard[1:]]
            assert ticks == straight == [1, 2, 3, 4, 5]
            numbers = [int(message["event"].partition(".")[2]) for message in heard]
            assert numbers == [*range(numbers[0], numbers[0] + 6)]


class Written:
    """A transport that writes down what it is given."""

    def __init__(self) -> None:
        self.closing = False
        self.frames: list[bytes] = []

    def is_closing(self) -> bool:
        return self.closing

    def write(self, data: bytes) -> None:
        self.frames.append(data)


async def test_nothing_is_written_to_who_is_full_or_going() -> None:
    protocol = DirectWriteProtocol.__new__(DirectWriteProtocol)
    transport = Written()
    protocol.transport = transport  # type: ignore[assignment]
    protocol.conn = ServerProtocol()
    protocol.writable = asyncio.Event()
    protocol.writable.set()
    assert not protocol._write_directly(b"not accepted yet")
    protocol.conn.state = State.OPEN
    assert protocol._write_directly(b"now")
    protocol.pause_writing()
    assert not protocol._write_directly(b"full")
    protocol.resume_writing()
    transport.closing = True
    assert not protocol._write_directly(b"lost")
    transport.closing = False
    protocol.conn.send_close(1012)
    assert not protocol._write_directly(b"closing")
    assert transport.frames == [encode_frame(b"now")]
