"""What is counted is what happened, and counting is cheap."""

from __future__ import annotations

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families
from websockets.asyncio.client import connect

from service import problems
from service.app import create_app
from service.http.metrics import Metrics, time_store
from service.server_timing import PARTS
from service.sessions.scheduler.wheel_clock import WheelClock
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running
from tests.support.service import Service


async def figures(service: Service) -> dict[tuple[str, str], float]:
    answer = await service.client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=")
    return {
        (sample.name, " ".join(sample.labels.values())): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


async def test_what_happened_is_counted(service: Service) -> None:
    empty = await figures(service)
    assert empty["roadtalk_sessions", ""] == 0
    path = await service.session()
    await service.say(path, "add two cars")
    await service.say(path, "order pizza")
    await service.client.get("/nowhere")
    now = await figures(service)
    assert now["roadtalk_sessions", ""] == 1
    assert now["roadtalk_watchers", ""] == 0
    assert now["roadtalk_command_seconds_count", "rest"] == 2
    assert now["roadtalk_command_seconds_bucket", "rest +Inf"] == 2
    assert now["roadtalk_command_seconds_sum", "rest"] > 0
    parts = {part: now["roadtalk_command_part_seconds_count", f"rest {part}"] for part in PARTS}
    assert parts == {"parse": 2, "apply": 1, "store": 1}  # the other was not understood
    assert now["roadtalk_command_seconds_count", "socket"] == 0
    whole = sum(now["roadtalk_command_part_seconds_sum", f"rest {part}"] for part in PARTS)
    assert 0 < whole <= now["roadtalk_command_seconds_sum", "rest"]
    assert now["roadtalk_refusals_total", "not-understood"] == 1
    assert now["roadtalk_refusals_total", "not-found"] == 1
    assert now["roadtalk_refusals_total", "internal"] == 0
    assert now["roadtalk_store_seconds_count", ""] >= empty["roadtalk_store_seconds_count", ""] + 2


async def test_a_socket_is_a_channel_of_its_own(settings: Settings) -> None:
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as at, httpx.AsyncClient(base_url=at.http, timeout=60) as client:
        path = (await client.post("/api/v1/sessions", json={"seed": 7})).headers["location"]
        async with connect(f"{at.ws}{path}/stream") as socket:
            await socket.recv()
            await socket.send('{"type": "command", "id": "1", "text": "add two cars"}')
            while '"result"' not in str(await socket.recv()):
                pass
            told = (await client.get("/metrics")).text
    assert 'roadtalk_command_seconds_count{channel="socket"} 1.0' in told
    assert 'roadtalk_command_seconds_count{channel="rest"} 0.0' in told
    assert "roadtalk_watchers 1.0" in told
    for part in PARTS:
        assert f'roadtalk_command_part_seconds_count{{channel="socket",part="{part}"}} 1.0' in told


async def test_those_that_sleep_are_counted_also_after_a_restart(service: Service) -> None:
    first, _ = await service.session(), await service.session()
    manager = service.app.state.context.manager
    assert (await figures(service))["roadtalk_sleeping_sessions", ""] == 0
    await manager.evict([await manager.get(first.rpartition("/")[2])], lambda _: True)
    assert (await figures(service))["roadtalk_sleeping_sessions", ""] == 1
    again = create_app(Settings(database="memory:"), store=service.store, clock=HandClock())
    async with again.router.lifespan_context(again):
        manager = again.state.context.manager
        assert (manager.live_count, manager.evicted_count) == (0, 2)
        session = await manager.get(first.rpartition("/")[2])
        assert (manager.live_count, manager.evicted_count) == (1, 1)
        await manager.fork(session, None)
        assert (manager.live_count, manager.evicted_count) == (2, 1)
        await manager.delete(session.id)
        assert (manager.live_count, manager.evicted_count) == (1, 1)


async def test_every_metric_is_described(service: Service) -> None:
    families = list(text_string_to_metric_families((await service.client.get("/metrics")).text))
    assert len(families) > 5
    assert all(family.documentation for family in families)


async def test_every_kind_of_refusal_is_there_from_the_start_and_no_other(service: Service) -> None:
    await service.client.get("/nowhere/<script>")
    kinds = {kind for name, kind in await figures(service) if name == "roadtalk_refusals_total"}
    assert kinds == {kind.slug for kind in problems.KINDS}


class Still:
    """A ticker that does nothing."""

    period_s = 0.5

    def tick(self) -> None:
        pass

    def tick_failed(self, error: Exception) -> None:
        raise error


def test_the_clock_tells_how_late_each_tick_is() -> None:
    now, told = [0.0], list[float]()
    clock = WheelClock(lambda: now[0], told.append)
    clock.add(Still())
    now[0] = 0.53
    clock.serve()
    assert told == [pytest.approx(0.03)]


async def test_a_timed_store_is_the_same_store() -> None:
    metrics = Metrics()
    store = time_store(MemoryStore(), metrics.store)
    await store.open()
    assert await store.newest(1) == []
    assert await store.get("nobody") is None
    assert metrics.registry.get_sample_value("roadtalk_store_seconds_count") == 3
    with pytest.raises(AttributeError):
        store.nothing  # type: ignore[attr-defined]  # noqa: B018
