"""StreamReader: messages as dataclasses, a service that is killed meanwhile, and how a stream ends."""

from __future__ import annotations

import json
from contextlib import aclosing
from pathlib import Path

import pytest
from websockets.exceptions import ConnectionClosedError
from websockets.frames import Close

from service.client import (
    AsyncClient,
    Changed,
    Client,
    Gone,
    Hello,
    Message,
    NotAllowed,
    NotReachable,
    RoadtalkError,
    Tick,
    UnknownSession,
)
from service.client.stream_reader import StreamReader
from tests.support.service_process import ServiceProcess


def test_what_happens_is_seen_until_the_end(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    stream = session.watch()
    hello = next(stream)
    assert isinstance(hello, Hello)
    assert (hello.session.id, hello.state.tick, hello.resumed) == (session.id, 0, False)
    session.say("add five potholes")
    changed = next(stream)
    assert isinstance(changed, Changed)
    assert (changed.text, changed.state.count("pothole")) == ("add five potholes", 9)
    stepped = session.step(2)
    ticks = [next(stream), next(stream)]
    assert [tick.tick for tick in ticks if isinstance(tick, Tick)] == [1, 2]
    assert ticks[1].raw["digest"] == stepped.state.digest
    assert isinstance(next(stream), Changed)
    session.delete()
    assert isinstance(next(stream), Gone)
    assert list(stream) == []


def test_a_service_that_is_killed_is_found_again(tmp_path: Path) -> None:
    service = ServiceProcess(tmp_path / "roads.db")
    service.start()
    try:
        with Client(service.url) as client:
            session = client.create(seed=11, paused=True)
            session.step(3)
            stream = session.watch()
            first = next(stream)
            service.kill()
            service.start()
            again = next(stream)
            assert isinstance(first, Hello)
            assert isinstance(again, Hello)
            assert (first.resumed, again.resumed) == (False, True)
            assert (again.sequence, again.state.digest) == (first.sequence, first.state.digest)
            assert session.step().state.tick == 4  # the pooled connection was lost as well
    finally:
        service.kill()


async def test_the_same_awaited(process: ServiceProcess) -> None:
    async with AsyncClient(process.url) as client:
        session = await client.create(seed=11, paused=True)
        seen: list[Message] = []
        async with aclosing(session.watch()) as stream:  # type: ignore[type-var]
            async for message in stream:
                seen.append(message)
                if isinstance(message, Hello):
                    await session.step(1)
                if isinstance(message, Changed):
                    await session.delete()
        assert [type(message) for message in seen] == [Hello, Tick, Changed, Gone]


async def test_a_session_that_is_not_there(process: ServiceProcess) -> None:
    async with AsyncClient(process.url) as client:
        with pytest.raises(UnknownSession):
            await anext(client.session("nobody").watch())
    with Client(process.url) as client, pytest.raises(UnknownSession):
        next(client.session("nobody").watch())


def closed(code: int) -> ConnectionClosedError:
    return ConnectionClosedError(Close(code, ""), None)


def watching(patience_s: float = 30) -> StreamReader:
    """One that has heard of change 7."""
    made = StreamReader("http://service", "s", None, patience_s)
    made.on_connected()
    message = made.read(json.dumps({"type": "later", "sequence": 7}))
    assert message is not None
    return made


def test_it_goes_on_from_the_last_message_seen() -> None:
    begun = StreamReader("http://service:80", "a/b", None, 30)
    assert begun.address == "ws://service:80/api/v1/sessions/a%2Fb/stream"
    with pytest.raises(RoadtalkError):
        begun.retry_delay_s(OSError("nobody there"))
    begun = StreamReader("https://service", "s", "a-5", 30)
    assert begun.address == "wss://service/api/v1/sessions/s/stream?after=a-5"
    begun.read('{"type": "later", "sequence": 9, "event": "a-6"}')
    assert begun.address.endswith("?after=a-6")
    begun.read('{"type": "later", "sequence": 10}')
    assert begun.address.endswith("?after=a-6")


@pytest.mark.parametrize("code", [1001, 1006, 1011, 1012, 1013])
def test_what_is_tried_again_waits_longer_each_time(code: int) -> None:
    lost = watching()
    delays = [lost.retry_delay_s(closed(code)) for _ in range(7)]
    assert delays == [0.1, 0.2, 0.4, 0.8, 1.6, 2.0, 2.0]
    lost.read('{"type": "later"}')
    assert lost.retry_delay_s(closed(code)) == 0.1


def test_patience_begins_anew_with_every_connection() -> None:
    lost = watching(patience_s=-1)
    with pytest.raises(NotReachable):
        lost.retry_delay_s(closed(1012))
    patient = watching()
    assert patient.retry_delay_s(closed(1012)) == 0.1
    patient.on_connected()
    assert patient._lost_since is None
    assert patient.retry_delay_s(closed(1012)) == 0.2  # quicker only once a message came


def test_what_is_over_is_over() -> None:
    assert watching().retry_delay_s(closed(1000)) is None
    with pytest.raises(NotAllowed, match="key"):
        watching().retry_delay_s(closed(4401))
    for code in (1008, 1009, 4404):
        with pytest.raises(RoadtalkError):
            watching().retry_delay_s(closed(code))
    impatient = watching(patience_s=-1)
    with pytest.raises(RoadtalkError):
        impatient.retry_delay_s(closed(1012))


def test_rubbish_is_told_and_pictures_passed_over() -> None:
    assert watching().read(b"\x00picture") is None
    for data in ("{", "[]", '{"kind": 1}', '{"type": "tick"}'):
        with pytest.raises(RoadtalkError):
            watching().read(data)
