"""Sessions that nobody uses are deleted where a setting says so, and no others."""

from __future__ import annotations

from collections.abc import AsyncIterator
from datetime import UTC, datetime, timedelta

import httpx
import pytest

from service.app import create_app
from service.sessions.persistence.retention import BATCH, Retention
from service.settings import Settings
from service.sharding import Shard
from service.store import MemoryStore, StoreError
from sim.config import Config
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

NOW = datetime.now(UTC)


class Years:
    """A retention whose time is said."""

    def __init__(self, service: Service, **settings: object) -> None:
        self.now = NOW
        self.gone: list[str] = []
        context = service.app.state.context
        self.manager = context.manager
        self.retention = Retention(
            context.store,
            context.manager,
            Settings(database="memory:", **settings),  # type: ignore[arg-type]
            self.gone.append,
            lambda: self.now,
        )

    async def sleep(self, *paths: str) -> None:
        """Sessions leave memory."""
        sessions = [self.manager.live_sessions[path.rpartition("/")[2]] for path in paths]
        assert await self.manager.evict(sessions, lambda _: True) == len(paths)

    async def after(self, days: float) -> int:
        self.now += timedelta(days=days)
        return await self.retention.sweep()


@pytest.fixture
async def service() -> AsyncIterator[Service]:
    clock, store = HandClock(), MemoryStore()
    app = create_app(Settings(database="memory:"), store=store, language=FewSentences(), clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


async def test_nothing_is_deleted_by_default(service: Service) -> None:
    years = Years(service)
    live, asleep = await service.session(paused=True), await service.session(paused=True)
    await years.sleep(asleep)
    assert await years.after(9_999) == 0
    assert (await service.client.get(asleep)).status_code == 200
    assert (await service.client.get(live)).status_code == 200


async def test_what_nobody_used_is_deleted_and_what_is_live_or_named_is_kept(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    live, asleep = await service.session(paused=True), await service.session(paused=True)
    named = await service.session(paused=True, name="mine")
    marked = await service.session(paused=True)
    await service.act(marked, {"do": "save", "name": "here"})
    await years.sleep(asleep, named, marked)
    assert await years.after(29) == 0
    assert await years.after(2) == 1
    assert years.gone == [asleep.rpartition("/")[2]]
    statuses = [(await service.client.get(each)).status_code for each in (live, asleep, named, marked)]
    assert statuses == [200, 404, 200, 200]
    assert years.manager.evicted_count == 0


async def test_named_sessions_go_too_where_that_is_said(service: Service) -> None:
    years = Years(service, keep_sessions_days=30, keep_named_sessions=False)
    await service.session(paused=True)
    named = await service.session(paused=True, name="mine")
    await years.sleep(named)
    assert await years.after(31) == 1
    assert (await service.client.get(named)).status_code == 404


async def test_whoever_asks_for_a_session_keeps_it(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    asleep = await service.session(paused=True)
    await years.sleep(asleep)
    assert await years.after(29) == 0
    assert (await service.client.get(asleep)).status_code == 200
    assert await years.after(20) == 0
    assert (await service.client.get(asleep)).status_code == 200


async def test_a_fork_outlives_what_it_came_from(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    parent = await service.session(paused=True)
    await service.act(parent, {"do": "add", "kind": "pothole", "count": 2})
    forked = await service.client.post(f"{parent}/forks", json={})
    before = (await service.state(forked.headers["location"]))["digest"]
    await years.sleep(parent)
    assert await years.after(31) == 1
    await years.sleep(forked.headers["location"])
    assert (await service.state(forked.headers["location"]))["digest"] == before


async def test_a_clock_that_jumps_while_nothing_is_used_deletes_nothing(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    asleep = await service.session(paused=True)
    await years.sleep(asleep)
    assert await years.after(365) == 0
    assert (await service.client.get(asleep)).status_code == 200


async def test_many_are_deleted_in_batches_and_the_longest_unused_first(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("service.sessions.persistence.retention.PAUSE_S", 0)
    years = Years(service, keep_sessions_days=30)
    await service.session(paused=True)
    made = [await service.session(paused=True) for _ in range(BATCH + 3)]
    for each in made:
        await years.sleep(each)
    assert await years.after(31) == BATCH + 3
    assert years.gone == [each.rpartition("/")[2] for each in made]


async def test_one_that_somebody_wakes_meanwhile_is_kept(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    await service.session(paused=True)
    asleep = await service.session(paused=True)
    await years.sleep(asleep)
    identity = asleep.rpartition("/")[2]
    session = await years.manager.get(identity)
    assert session.id == identity
    assert await years.manager.expire(identity) is False
    assert (await service.client.get(asleep)).status_code == 200


async def test_what_expired_is_counted_and_its_quota_is_free_again(monkeypatch: pytest.MonkeyPatch) -> None:
    store = MemoryStore()
    app = create_app(
        Settings(database="memory:", keep_sessions_days=1, max_client_sessions=2),
        store=store,
        language=FewSentences(),
        clock=HandClock(),
    )
    from service.app import _retention

    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        service = Service(app, client, HandClock(), store)
        first, second = await service.session(paused=True), await service.session(paused=True)
        manager = app.state.context.manager
        session = manager.live_sessions[first.rpartition("/")[2]]
        await manager.evict([session], lambda _: True)
        assert (await client.post("/api/v1/sessions", json={})).status_code == 429
        retention = _retention(app.state.context)
        monkeypatch.setattr(retention, "_now", lambda: NOW + timedelta(days=2))
        assert await retention.sweep() == 1
        assert (await client.post("/api/v1/sessions", json={})).status_code == 201
        assert "roadtalk_expired_sessions_total 1.0" in (await client.get("/metrics")).text
        assert (await client.get(second)).status_code == 200


async def test_a_store_that_fails_deletes_nothing_and_the_next_sweep_goes_on(service: Service) -> None:
    years = Years(service, keep_sessions_days=30)
    await service.session(paused=True)
    asleep = await service.session(paused=True)
    await years.sleep(asleep)
    delete = service.store.delete

    async def fails(_: str) -> bool:
        raise StoreError("the disk is full")

    years.manager._services.store.delete = fails
    with pytest.raises(StoreError):
        await years.after(31)
    assert (await service.client.get(asleep)).status_code == 200
    await years.sleep(asleep)
    years.manager._services.store.delete = delete
    assert await years.after(60) == 1


async def test_a_shard_deletes_its_own_however_many_are_of_others() -> None:
    """A session of another shard may have been woken there a moment ago."""
    store, clock = MemoryStore(), HandClock()
    apps = [
        create_app(
            Settings(database="memory:"),
            store=store,
            language=FewSentences(),
            clock=clock,
            shard=Shard(number, 2),
        )
        for number in range(2)
    ]
    for app, count in zip(apps, (BATCH + 5, 3), strict=True):
        manager = app.state.context.manager
        await manager.open()
        for _ in range(count):
            await manager.create(None, Config(), paused=True)
        await manager.evict(list(manager.live_sessions.values()), lambda _: True)
    await store.touch([each.id for each in await store.newest(1)], NOW + timedelta(days=99))
    last = Years(Service(apps[1], None, clock, store), keep_sessions_days=30)  # type: ignore[arg-type]
    assert await last.after(99) == 2
    first = Years(Service(apps[0], None, clock, store), keep_sessions_days=30)  # type: ignore[arg-type]
    assert await first.after(99) == BATCH + 5
    assert await store.count() == 1
