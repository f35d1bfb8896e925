"""Planners of another package, over REST: whatever they do the session goes on, and the log says why."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import httpx
import pytest

from sim import planner_names
from sim.plan.sandbox import answer_cache, worker
from tests.support import faulty_planners
from tests.support.service import Service

MADE = "/api/v1/sessions"
PATIENCE_S = 120.0


@cache
def patient(name: str) -> worker.Worker | None:
    """As `worker_of`, but only who is to hang is held to the time for one decision: a machine may be busy."""
    point = planner_names.installed().get(name)
    if point is None:
        return None
    budget_s = worker.BUDGET_S if name == "hangs" else PATIENCE_S
    return worker.Worker(name, point.value, budget_s, PATIENCE_S)


@pytest.fixture(autouse=True)
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The package of faulty planners on the path, for this process and its children."""
    faulty_planners.package(str(tmp_path))
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(worker, "worker_of", patient)
    planner_names.forget_installed()
    answer_cache.answers.clear()
    patient.cache_clear()
    yield
    for name in planner_names.installed():
        started = patient(name)
        if started is not None:
            started.stop()
    patient.cache_clear()
    planner_names.forget_installed()


async def made(client: httpx.AsyncClient, planner: str) -> str:
    body = {"seed": 5, "planner": planner, "paused": True}
    answer = await client.post(MADE, json=body)
    assert answer.status_code == 201, answer.text
    return str(answer.headers["location"])


async def log(client: httpx.AsyncClient, path: str) -> list[str]:
    return [line["text"] for line in (await client.get(f"{path}/events")).json()["items"]]


async def test_a_good_one_drives_as_the_rule_does(service: Service) -> None:
    digests = []
    for planner in ("good", "priority"):
        path = await made(service.client, planner)
        done = await service.client.post(f"{path}/actions", json={"actions": [{"do": "step", "ticks": 25}]})
        assert done.status_code == 200, done.text
        digests.append((await service.client.get(f"{path}/state")).json()["digest"])
    assert digests[0] == digests[1]


@pytest.mark.parametrize(
    ("planner", "said"),
    [
        ("raises", "raised ZeroDivisionError"),
        ("dies", "took its process down (exit status 3)"),
        ("nonsense", "answered what is no decision"),
        ("sideways", "answered what is no move"),
        ("endless", "asked for a horizon that cannot be"),
    ],
)
async def test_whatever_it_does_the_vehicle_stays_and_the_log_says_why(
    service: Service, planner: str, said: str
) -> None:
    path = await made(service.client, planner)
    before = (await service.client.get(f"{path}/state")).json()
    done = await service.client.post(f"{path}/actions", json={"actions": [{"do": "step", "ticks": 3}]})
    assert done.status_code == 200, done.text
    after = (await service.client.get(f"{path}/state")).json()
    assert after["tick"] == before["tick"] + 3
    told = [text for text in await log(service.client, path) if said in text]
    assert len(told) == 1  # when it begins, not at every tick
    assert f"planner {planner}" in told[0]
    recording = (await service.client.get(f"{path}/recording")).json()
    replayed = await service.client.post(MADE, json={"recording": recording})
    assert replayed.status_code == 201, replayed.text


async def test_a_planner_that_hangs_is_taken_over_from(service: Service) -> None:
    path = await made(service.client, "hangs")
    refused = await service.client.post(f"{path}/actions", json={"actions": [{"do": "step", "ticks": 9}]})
    assert refused.status_code == 422, refused.text
    assert "did not answer within 0.25 s" in refused.json()["detail"]
    assert (await service.client.get(f"{path}/state")).json()["tick"] == 0
    await service.client.post(f"{path}/actions", json={"actions": [{"do": "resume"}]})
    async with asyncio.timeout(60):
        while (await service.client.get(f"{path}/state")).json()["tick"] < 6:
            service.clock.tick()
            await asyncio.sleep(0)
    assert any("handed over to you" in text for text in await log(service.client, path))
    assert (await service.client.get(path)).json()["mode"] == "manual"
    await service.client.post(f"{path}/actions", json={"actions": [{"do": "pause"}]})
    recording = (await service.client.get(f"{path}/recording")).json()
    replayed = await service.client.post(MADE, json={"recording": recording})
    assert replayed.status_code == 201, replayed.text


async def test_one_that_is_not_there_is_refused_with_those_that_are(service: Service) -> None:
    answer = await service.client.post(MADE, json={"planner": "telepathy"})
    assert answer.status_code == 422
    assert "priority" in answer.text
    assert "good" in answer.text
