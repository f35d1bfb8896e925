"""Searches for worlds that a planner fails: by sentence and over HTTP, with cases that open in a session."""

from __future__ import annotations

import csv
import json
from collections.abc import AsyncIterator
from io import StringIO
from threading import Event
from typing import Any

import pytest

from service.store import MemoryStore
from sim.config import Config
from sim.falsify import Case, Falsification
from sim.falsify.case import replay
from sim.falsify.search import falsify
from tests.http.test_evaluations import ALL, Held, ended, started, until_done
from tests.support.service import Service

SMALL = {"columns": 6, "rows": 14}
BODY: dict[str, Any] = {"find": "worst", "runs": 40, "planners": ["priority"], "config": SMALL, "seed": 3}


@pytest.fixture
async def running() -> AsyncIterator[Service]:
    async for service in started(MemoryStore()):
        yield service


def bare(result: dict[str, Any]) -> dict[str, Any]:
    """A result as JSON without what the service adds in words."""
    plain: dict[str, Any] = json.loads(json.dumps(result))
    for each in plain["cases"]:
        each.pop("link", None)
        each.pop("scenario", None)
        each["case"]["why"] = ""
    return plain


async def test_the_sentence_starts_what_the_figures_do(running: Service) -> None:
    text = "search 40 worlds for one that makes A* crash"
    said = await running.client.post(ALL, json={"text": text, "seed": 3})
    typed = await running.client.post(
        ALL, json={"find": "worst", "runs": 40, "planners": ["astar"], "seed": 3}
    )
    assert (said.status_code, typed.status_code) == (202, 202), said.text
    assert said.json()["kind"] == "find_worst"
    found = [await ended(running, each.headers["location"]) for each in (said, typed)]
    assert found[0]["result"] == found[1]["result"]
    assert found[0]["state"] == "done"
    assert (found[0]["runs"], found[0]["done"], found[0]["planners"]) == (40, 40, ["astar"])
    assert found[0]["text"][0].startswith("A* failed in none of 40 worlds")


async def test_a_session_starts_one_and_its_log_tells_what_came_of_it(running: Service) -> None:
    path = await running.session(config=SMALL | {"planner": "priority", "vehicles": 3}, paused=True)
    answer = await running.say(path, "find the hardest scenario")
    assert answer.status_code == 200, answer.text
    (one,) = answer.json()["evaluations"]
    assert answer.json()["reply"].startswith("Started a search of 1,000 worlds")
    assert "/api" not in answer.json()["reply"]  # the link beside it opens the report
    await running.client.delete(one["links"]["self"])
    answer = await running.act(path, {"do": "find_worst", "runs": 30})
    (one,) = answer.json()["evaluations"]
    found = await ended(running, one["links"]["self"])
    assert (found["planners"], found["config"]["rows"]) == (["priority"], 14)
    log = (await running.client.get(f"{path}/events")).json()["items"]
    assert log[-1]["text"].startswith("The search is done: Priority rules failed in")


async def test_cases_fail_as_they_say_and_open_in_a_session(running: Service) -> None:
    found = await ended(running, (await running.client.post(ALL, json=BODY)).headers["location"])
    expected = falsify(
        Falsification(planner="priority", worlds=40, config=Config(columns=6, rows=14), seed=3)
    )
    assert expected is not None
    assert bare(found["result"]) == bare(expected)
    assert found["result"]["cases"]
    for number, each in enumerate(found["result"]["cases"], 1):
        case = Case.from_json(each["case"])
        assert replay(case).as_recorded(case)
        assert found["text"][number].startswith(f"{number}. Priority rules:")
        assert "without any one of them" in case.why or "without it" in case.why
        opened = await running.client.post("/api/v1/sessions", json={"link": each["link"], "name": case.name})
        assert opened.status_code == 201, opened.text
        assert (opened.json()["name"], opened.json()["tick"]) == (case.name, case.tick)
        step = await running.client.post(
            f"{opened.headers['location']}/step", json={"ticks": case.ticks - case.tick}
        )
        state = step.json()["state"]
        assert (state["status"], state["digest"]) == (case.outcome, case.digest)


async def test_the_report_in_every_format(running: Service) -> None:
    path = (await running.client.post(ALL, json=BODY)).headers["location"]
    found = await ended(running, path)
    page = await running.client.get(f"{path}/report")
    assert "The hardest of 40 worlds for Priority rules" in page.text
    assert "<script" not in page.text
    markdown = (await running.client.get(f"{path}/report", params={"format": "markdown"})).text
    for each in found["result"]["cases"]:
        assert f"](http://service/{each['link']})" in markdown
    saved = (await running.client.get(f"{path}/report", params={"format": "json"})).json()
    assert saved["result"] == found["result"]
    text = (await running.client.get(f"{path}/report", params={"format": "csv"})).text
    rows = list(csv.DictReader(StringIO(text)))
    assert [row["world"] for row in rows] == [str(index) for index in range(40)]
    failed = sum(row["finding"] in ("crashed", "stuck") for row in rows)
    assert failed == found["result"]["findings"]["crashed"] + found["result"]["findings"]["stuck"]


async def test_progress_is_what_is_done_and_a_restart_goes_on() -> None:
    store = MemoryStore()
    Held.go_on = Event()
    path = ""
    body = BODY | {"runs": 400}
    async for service in started(store, held=True):
        path = (await service.client.post(ALL, json=body)).headers["location"]
        found = await until_done(service, path, 20)
        assert (found["state"], found["done"]) == ("running", 20)
        assert 0 < found["progress"] < 0.06
        assert (await service.client.get(f"{path}/report")).status_code == 200
    (job,) = await store.jobs(9)
    assert set(await store.job_parts(job.id)) == {"0:0+20"}
    async for service in started(store):
        found = await ended(service, path)
        assert (found["done"], found["progress"]) == (400, 1)
        spec = Falsification(planner="priority", worlds=400, config=Config(columns=6, rows=14), seed=3)
        assert bare(found["result"]) == bare(falsify(spec) or {})


async def test_a_cancel_ends_it() -> None:
    Held.go_on = Event()
    async for service in started(MemoryStore(), held=True):
        path = (await service.client.post(ALL, json=BODY | {"runs": 400})).headers["location"]
        await until_done(service, path, 20)
        assert (await service.client.delete(path)).status_code == 204
        assert (await service.client.get(path)).json()["state"] == "cancelled"
        assert (await service.client.get(f"{path}/report")).status_code == 409


async def test_how_it_stands_and_its_end_can_be_said() -> None:
    Held.go_on = Event()
    async for service in started(MemoryStore(), held=True):
        path = await service.session(config=SMALL | {"planner": "priority", "vehicles": 3}, paused=True)
        answer = await service.act(path, {"do": "find_worst", "runs": 400})
        (one,) = answer.json()["evaluations"]
        await until_done(service, one["links"]["self"], 20)
        told = await service.act(path, {"do": "evaluation", "want": "progress"})
        assert "20 of 400 runs. (The hardest of 400 worlds for Priority rules.)" in told.json()["reply"]
        told = await service.act(path, {"do": "evaluation", "want": "cancel"})
        assert told.json()["reply"].startswith("Cancelled after 20 of 400 runs.")
        assert (await service.client.get(one["links"]["self"])).json()["state"] == "cancelled"


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"runs": 0}, "runs"),
        ({"runs": 1_000_000_000}, "runs"),
        ({"planners": ["best"]}, "planner"),
        ({"planners": ["dwa"]}, "planner"),
        ({"planners": ["astar", "rules"]}, "planners"),
        ({"road": "this"}, "road"),
        ({"text": "find the hardest scenario"}, "find"),
    ],
)
async def test_what_cannot_be_searched_is_said_before_it_begins(
    running: Service, body: dict[str, Any], field: str
) -> None:
    answer = await running.client.post(ALL, json={"find": "worst"} | body)
    assert answer.status_code == 422, answer.text
    assert field in [each["field"] for each in answer.json()["errors"]]
    assert (await running.client.get(ALL)).json()["items"] == []
