"""Dear requests over HTTP: done elsewhere, ended with their client, refused with the figure; others go on."""

from __future__ import annotations

import asyncio

import httpx
import pytest

from service.app import create_app
from service.http.protocol.request_timeout import TimeoutProtocol
from service.settings import Settings
from service.store import MemoryStore
from service.work.worker import Worker
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running
from tests.support.service import Service

LARGE = {"columns": 64, "rows": 156, "planner": "astar", "pedestrians": 300}


async def test_a_step_in_a_process_answers_as_one_beside_the_loop(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = [await service.session(config={"planner": "astar"}, paused=True) for _ in range(2)]
    here = (await service.client.post(f"{first}/step", json={"ticks": 40})).json()
    for name in ("executor.INLINE", "executor.THREAD"):
        monkeypatch.setattr(f"service.work.{name}", 0)
    monkeypatch.setattr("service.sessions.perform.THREAD", 0)
    there = (await service.client.post(f"{second}/step", json={"ticks": 40})).json()
    assert there["decisions"] == here["decisions"]
    assert len(here["decisions"]) > 30
    assert there["state"]["digest"] == here["state"]["digest"]


async def test_pages_of_decisions_are_the_same_from_a_process(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = await service.session(config={"planner": "astar"}, paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 40})
    calls = ("decisions?limit=40", "decisions/7", "moments", "timeline", "regret?limit=5", "forecast?tick=9")
    here = [(await service.client.get(f"{path}/{call}")).json() for call in calls]
    for name in ("INLINE", "THREAD"):
        monkeypatch.setattr(f"service.work.executor.{name}", 0)
    there = [(await service.client.get(f"{path}/{call}")).json() for call in calls]
    assert here == there
    beside = {"at_tick": 2, "move": "stay", "ticks": 40}
    answers = [(await service.client.post(f"{path}/counterfactual", json=beside)).json() for _ in range(2)]
    assert answers[0] == answers[1]


@pytest.mark.parametrize("settings", [Settings(database="memory:", max_work=1_000_000)])
async def test_what_is_too_dear_is_refused_with_the_figure_and_the_setting(service: Service) -> None:
    path = await service.session(config=LARGE, paused=True)
    for call in (
        service.client.post(f"{path}/step", json={"ticks": 1_000}),
        service.client.post(f"{path}/actions", json={"actions": [{"do": "step", "ticks": 900}]}),
    ):
        answer = await call
        problem = answer.json()
        assert (answer.status_code, problem["type"]) == (422, "/problems/too-much-work")
        assert "ROADTALK_MAX_WORK" in problem["detail"]
        assert "1,000,000" in problem["detail"]
    recording = {"format": "roadtalk-recording", "version": 1, "config": {**LARGE, "seed": 1}, "entries": []}
    body = {"recording": {**recording, "tick": 200_000, "digest": "0" * 32}}
    answer = await service.client.post("/api/v1/sessions", json=body)
    assert answer.json()["type"] == "/problems/too-much-work"
    assert (await service.client.get("/api/v1/sessions")).json()["items"][0]["tick"] == 0


async def test_a_recording_whose_sender_hangs_up_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    ended, begun = asyncio.Event(), asyncio.Event()

    async def never(_: Worker, packed: bytes) -> bytes:
        assert packed
        begun.set()
        try:
            return await asyncio.get_running_loop().create_future()
        except asyncio.CancelledError:
            ended.set()
            raise

    monkeypatch.setattr(Worker, "call", never)
    monkeypatch.setattr(TimeoutProtocol, "half_closed_s", 0.0)
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as live:
        body = (
            '{"recording":{"format":"roadtalk-recording","version":1,"config":{"seed":1,"planner":"astar"},'
            '"entries":[],"tick":200000,"digest":"' + "0" * 32 + '"}}'
        )
        _, writer = await asyncio.open_connection("127.0.0.1", live.port)
        head = (
            f"POST /api/v1/sessions HTTP/1.1\r\nHost: 127.0.0.1:{live.port}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
        )
        writer.write((head + body).encode())
        await asyncio.wait_for(begun.wait(), 60)
        async with httpx.AsyncClient(base_url=live.http) as client:
            assert (await client.get("/healthz")).status_code == 200
        writer.close()
        await asyncio.wait_for(ended.wait(), 60)
        manager = app.state.context.manager
        assert manager.work.fates["cancelled"] == 1
        assert manager.live_count == 0
