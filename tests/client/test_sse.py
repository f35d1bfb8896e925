"""Reading by server-sent events, and pictures by stream."""

from __future__ import annotations

import json
from contextlib import aclosing
from itertools import islice
from pathlib import Path

import httpx
import pytest

from service.client import (
    AsyncClient,
    Changed,
    Client,
    Gone,
    Hello,
    Invalid,
    NotReachable,
    Picture,
    Tick,
    UnexpectedAnswer,
    UnknownSession,
)
from service.client.sse import EventParser, EventStreamReader
from tests.support.service_process import ServiceProcess


def test_what_is_followed_is_what_is_watched(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    read, seen = session.follow(), session.watch()
    assert isinstance(next(read), Hello)
    assert isinstance(next(seen), Hello)
    session.say("add five potholes")
    session.step(2)
    told = [list(islice(each, 4)) for each in (read, seen)]
    assert [type(message) for message in told[0]] == [Changed, Tick, Tick, Changed]
    assert told[0] == told[1]
    session.delete()
    assert [type(message) for message in read] == [Gone]


async def test_the_same_awaited(process: ServiceProcess) -> None:
    async with AsyncClient(process.url) as client:
        session = await client.create(seed=11, paused=True)
        kinds = []
        async with aclosing(session.follow()) as stream:  # type: ignore[type-var]
            async for message in stream:
                kinds.append(type(message))
                if isinstance(message, Hello):
                    await session.step(1)
                if isinstance(message, Changed):
                    await session.delete()
        assert kinds == [Hello, Tick, Changed, Gone]
        with pytest.raises(UnknownSession):
            await anext(session.follow())


def test_a_service_that_is_killed_is_found_again(tmp_path: Path) -> None:
    service = ServiceProcess(tmp_path / "roads.db")
    service.start()
    try:
        with Client(service.url) as client:
            session = client.create(seed=11, paused=True)
            session.step(3)
            stream = session.follow()
            first = next(stream)
            service.kill()
            service.start()
            again = next(stream)
            assert isinstance(first, Hello)
            assert isinstance(again, Hello)
            assert (first.resumed, again.resumed) == (False, True)
            assert again.state.digest == first.state.digest
    finally:
        service.kill()


def test_what_was_missed_follows(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    last = next(session.follow()).raw["event"]
    session.step(2)
    assert [type(each) for each in islice(session.follow(after=last), 3)] == [Tick, Tick, Changed]


def test_what_cannot_be_followed(client: Client) -> None:
    with pytest.raises(UnknownSession):
        next(client.session("nobody").follow())
    page = httpx.MockTransport(lambda _: httpx.Response(200, html="<p>hello</p>"))
    with Client("http://service", transport=page) as stranger, pytest.raises(UnexpectedAnswer):
        next(stranger.session("s").follow())

    def nobody(_: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("nobody")

    silent = httpx.MockTransport(nobody)
    with (
        Client("http://service", transport=silent) as alone,
        pytest.raises(NotReachable),
    ):
        next(alone.session("s").follow())


def test_events_are_cut_where_they_end() -> None:
    following = EventStreamReader("http://service", "a/b", "e-1", 30)
    assert following.request(9)["headers"]["Last-Event-ID"] == "e-1"
    assert following.request(9)["url"].endswith("/a%2Fb/events/stream")
    said = {"type": "later", "event": "e-2", "text": "two\u2028lines"}
    whole = f"retry: 1000\n\nid: e-2\nevent: later\ndata: {json.dumps(said, ensure_ascii=False)}\n\n".encode()
    stops = b'event: stopping\ndata: {"type":"stopping","code":1012}\n\n: still here\n\n'
    events = EventParser()
    parts = [bytes((byte,)) for byte in whole + stops]
    messages = [message for part in parts for message in events.feed(part, following)]
    assert [message.raw for message in messages] == [said]
    assert following.request(9)["headers"]["Last-Event-ID"] == "e-2"
    with pytest.raises(UnexpectedAnswer):
        list(events.feed(b"data: {\n\n", following))


def test_pictures_come_while_something_moves(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    stream = session.pictures(form="webp", fps=60, side=96)
    first = next(stream)
    assert (first.tick, first.media_type, first.data[8:12]) == (0, "image/webp", b"WEBP")
    session.step(3)
    later = next(picture for picture in stream if picture.tick == 3)
    assert isinstance(later, Picture)
    assert 0 <= later.phase <= 1
    assert later._repr_html_().startswith('<img alt="the road" src="data:image/webp')


async def test_pictures_awaited(process: ServiceProcess) -> None:
    async with AsyncClient(process.url) as client:
        session = await client.create(seed=11, paused=True)
        async with aclosing(session.pictures(view="schematic", side=64)) as stream:  # type: ignore[type-var]
            assert (await anext(stream)).data[:2] == b"\xff\xd8"


def test_pictures_that_cannot_be_had_are_refused(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    with pytest.raises(Invalid) as refused:
        next(session.pictures(side=9))
    assert refused.value.errors[0].field == "side"
    with pytest.raises(UnknownSession):
        next(client.session("nobody").pictures())
