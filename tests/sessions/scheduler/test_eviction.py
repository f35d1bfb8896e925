"""Sessions that nobody needs are let go from memory, and come back as they were."""

from __future__ import annotations

import asyncio
import gc
import weakref
from collections.abc import Mapping
from typing import Any

import pytest

from service.app import create_app
from service.sessions.manager import SessionManager
from service.sessions.scheduler.eviction import CHECKS_PER_TIMEOUT, Evictor
from service.settings import Settings
from service.store import MemoryStore, StoreError
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

AFTER_S = 600.0


class Time:
    def __init__(self, service: Service) -> None:
        self.now_s = 100.0
        self.manager: SessionManager = service.app.state.context.manager
        self.manager.idle_times.now = lambda: self.now_s
        self.sleeper: Evictor = self.manager.evictor()

    async def look(self, later_s: float = 0.0) -> int:
        self.now_s += later_s
        return await self.sleeper.evict_idle()


@pytest.fixture
def time(service: Service) -> Time:
    return Time(service)


def kept(state: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in state.items() if key != "paused"}


async def test_it_sleeps_and_wakes_as_it_was(service: Service, time: Time) -> None:
    path = await service.session(paused=True)
    await service.say(path, "add five potholes")
    await service.act(path, {"do": "step", "ticks": 30})
    await service.act(path, {"do": "set", "parameter": "playback_speed", "value": 8})
    before = await service.state(path)
    held = weakref.ref(await time.manager.get(path.rsplit("/", 1)[1]))
    assert await time.look() == 0
    assert await time.look(AFTER_S - 1) == 0, "not yet"
    assert await time.look(1) == 1
    gc.collect()
    assert held() is None, "its memory is free"
    assert time.manager.live_count == 0
    (listed,) = (await service.client.get("/api/v1/sessions")).json()["items"]
    assert (listed["live"], listed["tick"]) == (False, 30)
    assert await service.state(path) == before
    assert time.manager.live_count == 1
    await service.act(path, {"do": "undo"})
    assert (await service.state(path))["sequence"] == 4


async def test_whoever_asks_keeps_it_awake(service: Service, time: Time) -> None:
    path = await service.session(paused=True)
    await time.look()
    for _ in range(5):
        time.now_s += AFTER_S - 1
        await service.client.get(f"{path}/events")
        assert await time.look() == 0


async def test_whoever_watches_keeps_it_awake(service: Service, time: Time) -> None:
    path = await service.session(paused=True)
    session = await time.manager.get(path.rsplit("/", 1)[1])
    subscriber = session.subscribers.subscribe()
    assert await time.look(10 * AFTER_S) == 0
    session.subscribers.unsubscribe(subscriber)
    assert await time.look(AFTER_S - 1) == 0, "from when the last one left"
    assert await time.look(1) == 1


async def test_a_running_session_goes_on(service: Service, time: Time) -> None:
    path = await service.session()
    await time.look()
    assert await time.look(10 * AFTER_S) == 0
    service.clock.tick(3)
    assert (await service.state(path))["tick"] == 3


async def test_a_running_one_sleeps_where_the_setting_says_so() -> None:
    settings = Settings(database="memory:", sleep_running=True)
    clock, store = HandClock(), MemoryStore()
    app = create_app(settings, store=store, language=FewSentences(), clock=clock)
    import httpx

    async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client:
        service = Service(app, client, clock, store)
        time = Time(service)
        path = await service.session()
        clock.tick(7)
        before = await service.state(path)
        await time.look()
        assert await time.look(AFTER_S) == 1
        assert clock.tickers == []
        after = await service.state(path)
        assert (after["tick"], after["paused"]) == (7, True)
        assert kept(after) == kept(before)


class SlowStore(MemoryStore):
    """Lets a test act while ticks are being stored."""

    def __init__(self) -> None:
        super().__init__()
        self.asked, self.go, self.broken = asyncio.Event(), asyncio.Event(), False

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        self.asked.set()
        await self.go.wait()
        if self.broken:
            raise StoreError("the disk is full")
        await super().save_ticks(ticks)


async def _slow(running: bool) -> tuple[SlowStore, HandClock, Time, Service]:
    import httpx

    clock, store = HandClock(), SlowStore()
    settings = Settings(database="memory:", sleep_running=running)
    app = create_app(settings, store=store, language=FewSentences(), clock=clock)
    client = httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service")
    service = Service(app, client, clock, store)
    return store, clock, Time(service), service


async def test_who_comes_while_it_is_put_to_sleep_keeps_it() -> None:
    store, clock, time, service = await _slow(running=True)
    path = await service.session()
    await time.look()
    looking = asyncio.ensure_future(time.look(AFTER_S))
    await store.asked.wait()
    assert clock.tickers == [], "it stands still while its tick is stored"
    answer = await service.say(path, "add five potholes")
    assert answer.status_code == 200
    store.go.set()
    assert await looking == 0
    assert time.manager.live_count == 1
    clock.tick()
    assert (await service.state(path))["tick"] == 1, "and it goes on"
    await service.client.aclose()


async def test_a_store_that_fails_lets_nothing_go() -> None:
    store, clock, time, service = await _slow(running=True)
    await service.session()
    store.go.set()
    store.broken = True
    await time.look()
    with pytest.raises(StoreError):
        await time.look(AFTER_S)
    assert (time.manager.live_count, len(clock.tickers)) == (1, 1)
    await service.client.aclose()


async def test_a_deleted_one_is_forgotten(service: Service, time: Time) -> None:
    path = await service.session(paused=True)
    await service.client.get(path)
    await service.client.delete(path)
    assert await time.look(AFTER_S) == 0
    assert time.manager.idle_times._used_s == {}


async def test_it_looks_by_itself(service: Service, time: Time, monkeypatch: pytest.MonkeyPatch) -> None:
    path = await service.session(paused=True)
    await service.client.get(path)
    slept: list[float] = []

    async def sleep(seconds: float) -> None:
        slept.append(seconds)
        time.now_s += seconds
        if not time.manager.live_count:
            raise asyncio.CancelledError

    monkeypatch.setattr("service.sessions.scheduler.eviction.asyncio.sleep", sleep)
    with pytest.raises(asyncio.CancelledError):
        await time.sleeper.run()
    assert slept == [AFTER_S / CHECKS_PER_TIMEOUT] * (CHECKS_PER_TIMEOUT + 1)
