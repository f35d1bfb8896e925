"""Those who send rubbish, or too much, on real sockets: refused or cut off, and nobody else is the worse.

The same in large, with what it costs, is `python -m bench.readers`.
"""

from __future__ import annotations

import asyncio
import random
from collections import Counter
from collections.abc import AsyncIterator

import httpx
import pytest

from bench.asking import Line, request
from bench.rubbish import garbage, message, poured
from bench.sockets import opened
from service.app import create_app
from service.sessions.subscribers import QUEUE_SIZE, MissedTicks, StreamMessage, Subscribers
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running

SESSIONS = 5


@pytest.fixture
async def clock() -> HandClock:
    return HandClock()


@pytest.fixture
async def live(clock: HandClock) -> AsyncIterator[Running]:
    settings = Settings(database="memory:", max_sessions=SESSIONS)
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=clock)
    async with running(app, settings) as service:
        yield service


async def made(service: Running) -> str:
    async with Line(service.http) as line:
        asked = request("POST", "/api/v1/sessions", line.host, b"{}", Content_Type="application/json")
        answer = await line.ask(asked)
    assert answer.status == 201
    return answer.headers["location"]


async def well(service: Running) -> bool:
    async with Line(service.http) as line:
        return (await line.ask(request("GET", "/readyz", line.host))).status == 200


async def test_garbage_requests_are_no_failures(live: Running) -> None:
    path, dice, answers = await made(live), random.Random(11), Counter[int]()
    async with Line(live.http) as line:
        for _ in range(120):
            answers[(await line.ask(garbage(dice, path, line.host))).status] += 1
    assert all(200 <= status < 500 for status in answers), answers
    assert len(answers) > 4
    assert await well(live)


async def test_garbage_messages_end_their_own_socket_alone(live: Running) -> None:
    path, dice = await made(live), random.Random(12)
    answered = asyncio.Event()

    def heard(told: bytes) -> None:
        if told.startswith(b'{"type":"pong"'):
            answered.set()

    beside = await opened(live.http, f"{path}/stream", heard)
    for _ in range(3):
        errors: list[bytes] = []
        socket = await opened(live.http, f"{path}/stream", errors.append)
        for _ in range(40):
            socket.say(message(dice))
        await asyncio.wait_for(socket.ended.wait(), 60)
        assert socket.code == 1008
        assert sum(told.startswith(b'{"type":"error"') for told in errors) == 20
    beside.say(b'{"type":"ping"}')
    await asyncio.wait_for(answered.wait(), 60)
    assert await well(live)


@pytest.mark.parametrize("chunked", [False, True])
async def test_a_body_far_too_large_is_cut_off_not_read(live: Running, chunked: bool) -> None:
    status, taken = await poured(live.http, f"{await made(live)}/actions", 50_000_000, chunked=chunked)
    assert status == 413
    assert taken < 10_000_000, "what lies in the system's buffers is not what was read"
    assert await well(live)


async def test_a_message_far_too_large_ends_its_socket(live: Running) -> None:
    socket = await opened(live.http, f"{await made(live)}/stream", lambda _: None)
    socket.say(b'{"type":"ping","x":"' + b"x" * 200_000 + b'"}')
    await asyncio.wait_for(socket.ended.wait(), 60)
    assert socket.code == 1009
    assert await well(live)


async def test_sessions_beyond_the_limit_are_refused_and_the_others_go_on(
    live: Running, clock: HandClock
) -> None:
    async with httpx.AsyncClient(base_url=live.http, timeout=60) as client:
        answers = [await client.post("/api/v1/sessions", json={}) for _ in range(30)]
        statuses = [answer.status_code for answer in answers]
        assert statuses == [201] * SESSIONS + [429] * (30 - SESSIONS)
        assert answers[-1].json()["type"] == "/problems/too-many-sessions"
        clock.tick(3)
        states = [
            (await client.get(f"{each.headers['location']}/state")).json() for each in answers[:SESSIONS]
        ]
    assert [state["tick"] for state in states] == [3] * SESSIONS


async def test_those_who_never_read_hold_little_and_hold_up_nobody() -> None:
    subscribers = Subscribers()
    silent, reader = [subscribers.subscribe() for _ in range(50)], subscribers.subscribe()
    heard: list[StreamMessage] = []
    for tick in range(2_000):
        subscribers.publish(tick, lambda tick=tick: b'{"type":"tick","tick":%d}' % tick)  # type: ignore[misc]
        told = await reader.next()
        assert isinstance(told, list)
        heard += told
    assert [notice.tick for notice in heard] == list(range(2_000))
    assert [await subscriber.next() for subscriber in silent] == [MissedTicks(0, 1_999)] * 50
    for tick in range(QUEUE_SIZE):
        subscribers.publish(tick, lambda: b'{"type":"tick"}')
    for subscriber in silent:
        assert len(await subscriber.next()) == QUEUE_SIZE  # type: ignore[arg-type]
