"""Planners that mean harm, in a live service: it goes on, says what is so, and runs nothing of theirs."""

from __future__ import annotations

import asyncio
import os
import threading
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from sim import planner_names
from sim.plan.sandbox import answer_cache, worker
from tests.support import faulty_planners
from tests.support.hostile_planners import HOSTILE, POSING, payload_path
from tests.support.service import Service

MADE = "/api/v1/sessions"
ENOUGH_TICKS = 3
PATIENCE_S = 120.0

FAULTS = {
    "raises": "raised ValueError",
    "exits": "raised SystemExit",
    "dies": "took its process down (exit status 3)",
    "aborts": "took its process down (killed by SIGABRT)",
    "nothing": "answered what is no decision",
    "nan": "answered a cost that is no finite number",
    "huge": "answered a cost that is too large a number",
    "other-tick": "answered for another moment or vehicle",
    "pickled": "answered without a verdict on each of the six moves",
    "garbles": "answered what is no JSON of an answer",
    "pours": "answered at too great a length",
}
"""What the log says of some of them."""


@cache
def worker_of(name: str) -> worker.Worker | None:
    """As `worker.worker_of`, but who is known to fail at once has more time for it: a machine may be busy."""
    point = planner_names.installed().get(name)
    if point is None:
        return None
    budget_s = PATIENCE_S if name in FAULTS else worker.BUDGET_S
    return worker.Worker(name, point.value, budget_s, PATIENCE_S)


@pytest.fixture(autouse=True)
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Their package on the path, and one that takes names that are not its own."""
    faulty_planners.package(str(tmp_path), HOSTILE, "hostile")
    faulty_planners.package(str(tmp_path), POSING, "posing")
    monkeypatch.syspath_prepend(str(tmp_path))
    planner_names.forget_installed()
    monkeypatch.setattr(worker, "worker_of", worker_of)
    answer_cache.answers.clear()
    payload_path(os.getpid()).unlink(missing_ok=True)
    yield
    for name in planner_names.installed():
        asked = worker_of(name)
        assert asked is not None
        asked.stop()
    worker_of.cache_clear()
    planner_names.forget_installed()
    assert not payload_path(os.getpid()).exists(), "a payload ran here"


async def made(service: Service, planner: str, **more: object) -> str:
    answer = await service.client.post(MADE, json={"seed": 5, "planner": planner, **more})
    assert answer.status_code == 201, answer.text
    return str(answer.headers["location"])


async def driven(service: Service, paths: dict[str, str]) -> None:
    """Tick until each session has got somewhere, or was handed over."""
    async with asyncio.timeout(PATIENCE_S):
        waiting = set(paths)
        while waiting:
            service.clock.tick()
            for planner in list(waiting):
                seen = (await service.client.get(paths[planner])).json()
                if seen["tick"] >= ENOUGH_TICKS or seen["mode"] == "manual":
                    waiting.discard(planner)
            await asyncio.sleep(0)


async def test_all_of_them_at_once_beside_one_that_behaves(service: Service) -> None:
    assert len(HOSTILE) >= 25
    paths = {planner: await made(service, planner) for planner in ("priority", *HOSTILE)}
    threads = threading.active_count()
    await driven(service, paths)
    assert threading.active_count() <= threads + 8, "as many threads as ever"
    for planner, path in paths.items():
        await service.act(path, {"do": "pause"})
        await _nothing_of_theirs(service, planner, path)
    for planner, said in FAULTS.items():
        log = (await service.client.get(f"{paths[planner]}/events")).json()["items"]
        told = f"The planner {planner} {said}: I stay where I am."
        assert told in [line["text"] for line in log], planner
    for planner in ("never", "busy", "prints", "complains"):
        assert (await service.client.get(paths[planner])).json()["mode"] == "manual", planner


async def _nothing_of_theirs(service: Service, planner: str, path: str) -> None:
    """All that is told of a session's decisions is what the rule would see; nothing fails."""
    asked: list[tuple[str, str, Any]] = [
        ("GET", f"{path}/decisions", None),
        ("GET", f"{path}/events", None),
        ("GET", f"{path}/timeline", None),
        ("GET", f"{path}/moments", None),
        ("GET", f"{path}/recording", None),
        ("GET", f"{path}/state?tick=0", None),
        ("POST", f"{path}/ask", {"about": "why"}),
    ]
    told = {}
    for method, where, body in asked:
        answer = await service.client.request(method, where, json=body)
        assert answer.status_code < 500, (planner, where, answer.text)
        assert "pedestrian-666" not in answer.text, (planner, where)
        told[where.rpartition("/")[2]] = answer
    session = await service.app.state.context.manager.get(path.rpartition("/")[2])
    for decision in told["decisions"].json()["items"]:
        run = session.timeline.at(decision["tick"])
        assert decision["planner"] in (planner, "manual")
        own = faulty_planners.PriorityPlanner().decide(_forecast(run), run.config)
        seen = {each["move"]: (each["reason"], each["cell"], each["causes"]) for each in decision["options"]}
        assert seen == {
            each.move: (each.reason, None if each.cell is None else [*each.cell], [*each.causes])
            for each in own.options
        }


def _forecast(run: Any) -> Any:
    from sim.forecast import Forecast

    return Forecast.of_truth(run.world, run.config, 1)


async def test_a_question_is_not_waited_for_on_the_event_loop(service: Service) -> None:
    """While one planner is asked, another session is answered."""
    path, other = await made(service, "starts-slowly", paused=True), await made(service, "priority")
    asked = asyncio.create_task(service.client.post(f"{path}/step", json={"ticks": 1}))
    answered = 0
    while not asked.done():
        assert (await service.client.get(other)).status_code == 200
        answered += 1
        await asyncio.sleep(0)
    assert (await asked).status_code == 200, (await asked).text
    assert answered > 20


async def test_what_was_decided_is_told_without_asking_again(service: Service) -> None:
    path = await made(service, "slow")
    await driven(service, {"slow": path})
    before = (await service.client.get(f"{path}/decisions")).json()
    asked = worker_of("slow")
    assert asked is not None
    asked.stop()
    answer_cache.answers.clear()
    after = (await service.client.get(f"{path}/decisions")).json()
    assert asked._line is None, "it was not asked"
    assert [each["move"] for each in after["items"]] == [each["move"] for each in before["items"]]
    assert [each["narration"] for each in after["items"]] == [each["narration"] for each in before["items"]]


@pytest.mark.parametrize("planner", ["AStar", "Rules", "manual", " dijkstra"])
async def test_names_that_are_not_theirs_cannot_be_chosen(service: Service, planner: str) -> None:
    answer = await service.client.post(MADE, json={"planner": planner})
    assert answer.status_code == 422, answer.text


async def test_a_package_does_not_get_the_name_of_a_planner_of_ours(service: Service) -> None:
    assert "astar" not in planner_names.installed()
    assert {name for name, _, _ in planner_names.refused()} == {name.strip() for name in POSING}
    path = await made(service, "astar", paused=True)
    done = await service.client.post(f"{path}/step", json={"ticks": 2})
    assert (
        done.json()["decisions"][0]["options"][0]["cost"] > 5
    )  # of the whole way, and not a place in an order
