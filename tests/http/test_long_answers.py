"""Long answers over HTTP: 202 where the client prefers that, progress, the result, cancelling."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from service.http import prefer
from service.http.routes import regret
from service.problems import NotAvailable
from service.work.executor import WorkExecutor
from service.work.long_answers import MOST_KEPT
from service.work.progress import HEARD
from tests.support.service import Service

ASYNC = {"Prefer": "respond-async"}


@pytest.fixture
def all_long(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every answer is long, however little it takes."""
    monkeypatch.setattr(prefer, "LONG_UNITS", 0)


@pytest.fixture
def judging(monkeypatch: pytest.MonkeyPatch) -> asyncio.Event:
    """Judging tells that it is half done, and waits to be let go on."""
    go_on, run = asyncio.Event(), WorkExecutor.run

    async def run_halfway(
        self: WorkExecutor, units: int, function: Callable[..., Any], *args: Any, **named: Any
    ) -> Any:
        if function is regret._judge_all:
            heard = HEARD.get()
            assert heard is not None
            heard(0.5)
            await go_on.wait()
        return await run(self, units, function, *args, **named)

    monkeypatch.setattr(WorkExecutor, "run", run_halfway)
    return go_on


async def stepped(service: Service, ticks: int = 5) -> str:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": ticks})
    return path


async def waited(service: Service, own: str, state: str, progress: float = 0.0) -> dict[str, Any]:
    while True:
        told: dict[str, Any] = (await service.client.get(own)).json()
        if told["state"] == state and told["progress"] >= progress:
            return told
        await asyncio.sleep(0)


@pytest.mark.usefixtures("all_long")
async def test_a_long_answer_is_the_one_that_is_given_at_once(service: Service) -> None:
    path = f"{await stepped(service)}/regret"
    accepted = await service.client.get(path, headers={"Prefer": "wait=1, respond-async"})
    assert accepted.status_code == 202
    assert accepted.headers["Preference-Applied"] == "respond-async"
    own = accepted.json()["links"]["self"]
    assert accepted.headers["Location"] == own
    told = await waited(service, own, "done")
    assert (told["what"], told["progress"]) == ("regret", 1.0)
    result = await service.client.get(told["links"]["result"])
    assert result.status_code == 200
    assert result.json() == (await service.client.get(path)).json()


async def test_what_is_quick_is_answered_at_once_and_so_is_who_prefers_nothing(service: Service) -> None:
    path = f"{await stepped(service)}/regret"
    assert (await service.client.get(path, headers=ASYNC)).status_code == 200


async def test_what_takes_longer_than_was_estimated_is_answered_202(
    service: Service, judging: asyncio.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prefer, "PATIENCE_S", 0.0)
    path = f"{await stepped(service)}/regret"
    accepted = await service.client.get(path, headers=ASYNC)
    assert accepted.status_code == 202
    judging.set()
    told = await waited(service, accepted.json()["links"]["self"], "done")
    assert (await service.client.get(told["links"]["result"])).status_code == 200


async def test_a_quick_answer_is_not_kept(service: Service) -> None:
    path = f"{await stepped(service)}/regret"
    for _ in range(MOST_KEPT + 1):
        assert (await service.client.get(path, headers=ASYNC)).status_code == 200


@pytest.mark.usefixtures("all_long")
async def test_who_prefers_nothing_waits(service: Service) -> None:
    path = f"{await stepped(service)}/regret"
    for headers in ({}, {"Prefer": "return=minimal"}):
        assert (await service.client.get(path, headers=headers)).status_code == 200


@pytest.mark.usefixtures("all_long")
async def test_progress_is_told_and_a_cancelled_one_is_unknown(
    service: Service, judging: asyncio.Event
) -> None:
    path = f"{await stepped(service)}/regret"
    own = (await service.client.get(path, headers=ASYNC)).json()["links"]["self"]
    told = await waited(service, own, "running", progress=0.5)
    assert told["links"]["self"] == own
    early = await service.client.get(f"{own}/result")
    assert (early.status_code, early.json()["progress"]) == (409, 0.5)
    assert early.json()["type"] == "/problems/not-there-yet"
    assert (await service.client.delete(own)).status_code == 204
    for call in (service.client.get(own), service.client.get(f"{own}/result"), service.client.delete(own)):
        assert _problem(await call) == (404, "/problems/unknown-answer")
    assert not judging.is_set()


@pytest.mark.usefixtures("all_long")
async def test_a_problem_has_the_status_that_it_would_have_had(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise NotAvailable("Not here.")

    monkeypatch.setattr(regret, "_judge_all", refuse)
    path = f"{await stepped(service)}/regret"
    own = (await service.client.get(path, headers=ASYNC)).json()["links"]["self"]
    told = await waited(service, own, "failed")
    result = await service.client.get(told["links"]["result"])
    assert _problem(result) == (NotAvailable.status, "/problems/not-available")


@pytest.mark.usefixtures("all_long")
async def test_what_is_wrong_with_a_request_is_said_at_once(service: Service) -> None:
    path = await stepped(service)
    wrong = await service.client.get(f"{path}/film?from=4&to=2", headers=ASYNC)
    assert wrong.status_code == 422


def _problem(answer: httpx.Response) -> tuple[int, str]:
    return answer.status_code, answer.json()["type"]
