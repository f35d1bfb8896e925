"""Evaluations over HTTP and by sentences: refused before they begin, true progress, and the reports."""

from __future__ import annotations

import asyncio
import csv
import json
import re
from collections.abc import AsyncIterator, Iterator, Sequence
from io import StringIO
from threading import Event
from typing import Any

import httpx
import pytest
from pydantic import SecretStr

from service.app import create_app
from service.grammar import Language
from service.scenarios import named_scenario
from service.scenarios.evaluation import evaluation_of_scenario
from service.settings import Settings
from service.store import MemoryStore, StoreError
from sim.config import Config
from sim.evaluate import Evaluation
from sim.evaluate.executor import InProcess, Piece
from sim.evaluate.run import evaluate
from tests.support.fakes import HandClock
from tests.support.service import Service

ALL = "/api/v1/evaluations"


class Held(InProcess):
    """Runs one piece, and the others once it is let go on."""

    go_on = Event()

    def run(self, work: Any, pieces: Sequence[Any], cancelled: Event) -> Iterator[tuple[Piece, Any]]:
        for number, each in enumerate(super().run(work, pieces, cancelled)):
            yield each
            while number == 0 and not self.go_on.wait(0.02) and not cancelled.is_set():
                pass


async def started(store: MemoryStore, held: bool = False) -> AsyncIterator[Service]:
    clock = HandClock()
    app = create_app(
        Settings(database="memory:"),
        store=store,
        language=Language.load("en"),
        clock=clock,
        make_executor=Held if held else InProcess,
    )
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


@pytest.fixture
async def running() -> AsyncIterator[Service]:
    async for service in started(MemoryStore()):
        yield service


@pytest.fixture
async def held() -> AsyncIterator[Service]:
    Held.go_on = Event()
    async for service in started(MemoryStore(), held=True):
        yield service


async def ended(service: Service, path: str) -> dict[str, Any]:
    await service.app.state.context.jobs.wait(path.rpartition("/")[2])
    return dict((await service.client.get(path)).json())


async def until_done(service: Service, path: str, episodes: int) -> dict[str, Any]:
    while (found := (await service.client.get(path)).json())["done"] < episodes:  # noqa: ASYNC110
        await asyncio.sleep(0.01)
    return dict(found)


async def test_the_sentence_starts_what_the_figures_do_and_the_report_says_what_came_of_it(
    running: Service,
) -> None:
    text = "run 30 episodes with A* and compare with the rule planner"
    said = await running.client.post(ALL, json={"text": text, "seed": 30})
    typed = await running.client.post(ALL, json={"runs": 30, "planners": ["astar", "priority"], "seed": 30})
    assert (said.status_code, typed.status_code) == (202, 202)
    found = [await ended(running, each.headers["location"]) for each in (said, typed)]
    assert found[0]["result"] == found[1]["result"]
    spec = Evaluation(planners=("astar", "priority"), episodes=30, seed=30)
    assert found[0]["result"] == json.loads(json.dumps(evaluate(spec)))
    assert found[0]["state"] == "done"
    assert (found[0]["done"], found[0]["progress"]) == (30, 1)
    assert found[0]["text"][0].startswith("A* arrived in every one of 30 runs")
    arrived = found[0]["result"]["planners"]["priority"]["arrived"]["count"]
    assert f"arrived in {arrived} of 30 runs" in found[0]["text"][1]


async def test_the_report_is_one_page_and_its_links_open_the_episodes(running: Service) -> None:
    made = await running.client.post(ALL, json={"runs": 30, "planners": ["astar", "priority"], "seed": 30})
    path = made.headers["location"]
    found = await ended(running, path)
    page = await running.client.get(f"{path}/report")
    assert page.headers["content-type"].startswith("text/html")
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert "A* arrived in every one of 30 runs" in page.text
    assert "<script" not in page.text
    assert 'src="http' not in page.text
    stuck = [each for each in found["result"]["examples"] if each["outcome"] == "stuck"]
    assert stuck
    markdown = (await running.client.get(f"{path}/report", params={"format": "markdown"})).text
    links = [line.partition("](http://service/")[2].partition(")")[0] for line in markdown.splitlines()]
    links = [link for link in links if link]
    assert len(links) == len(found["result"]["examples"])
    for link, example in zip(links, found["result"]["examples"], strict=True):
        opened = await running.client.post("/api/v1/sessions", json={"link": link})
        assert opened.status_code == 201, opened.text
        session = opened.json()
        assert session["tick"] == example["tick"]
        assert session["config"]["planner"] == example["planner"]
        left = example["ticks"] - example["tick"]
        stepped = await running.client.post(f"{opened.headers['location']}/step", json={"ticks": left})
        assert stepped.json()["state"]["status"] == example["outcome"]


async def test_the_csv_has_every_episode_once(running: Service) -> None:
    made = await running.client.post(ALL, json={"runs": 45, "planners": ["rules", "bfs"]})
    path = made.headers["location"]
    found = await ended(running, path)
    text = (await running.client.get(f"{path}/report", params={"format": "csv"})).text
    rows = list(csv.DictReader(StringIO(text)))
    assert [(row["episode"], row["planner"]) for row in rows if row["planner"] == "bfs"] == [
        (str(index), "bfs") for index in range(45)
    ]
    assert len(rows) == 90
    for planner, figures in found["result"]["planners"].items():
        arrived = [row for row in rows if row["planner"] == planner and row["outcome"] == "success"]
        assert len(arrived) == figures["arrived"]["count"]


async def test_progress_is_what_is_done_and_a_cancel_ends_it(held: Service) -> None:
    path = (await held.client.post(ALL, json={"runs": 60})).headers["location"]
    found = await until_done(held, path, 20)
    assert (found["state"], found["done"], found["progress"]) == ("running", 20, pytest.approx(1 / 3))
    assert found["result"] is None
    page = await held.client.get(f"{path}/report")
    assert 'value="20"' in page.text
    assert (await held.client.get(f"{path}/report", params={"format": "csv"})).status_code == 409
    assert (await held.client.delete(path)).status_code == 204
    assert (await held.client.get(path)).json()["state"] == "cancelled"
    assert (await held.client.get(f"{path}/report")).status_code == 409
    assert [each["state"] for each in (await held.client.get(ALL)).json()["items"]] == ["cancelled"]
    assert (await held.client.delete(path)).status_code == 204
    assert (await held.client.get(path)).status_code == 404


async def test_one_that_waits_can_be_cancelled_before_it_begins(held: Service) -> None:
    paths = [(await held.client.post(ALL, json={"runs": 40})).headers["location"] for _ in range(2)]
    await until_done(held, paths[0], 20)
    assert (await held.client.get(paths[1])).json()["state"] == "queued"
    await held.client.delete(paths[1])
    Held.go_on.set()
    assert (await ended(held, paths[0]))["state"] == "done"
    assert (await held.client.get(paths[1])).json()["state"] == "cancelled"


async def test_a_restart_goes_on_where_it_was_and_finds_the_same() -> None:
    store = MemoryStore()
    Held.go_on = Event()
    path = ""
    async for service in started(store, held=True):
        path = (await service.client.post(ALL, json={"runs": 60, "seed": 9})).headers["location"]
        await until_done(service, path, 20)
    (job,) = await store.jobs(9)
    assert (job.state, job.done) == ("running", 20)
    assert set(await store.job_parts(job.id)) == {"0+20"}
    async for service in started(store):
        found = await ended(service, path)
        assert found["done"] == 60
        expected = evaluate(Evaluation(planners=("rules",), episodes=60, seed=9))
        assert found["result"] == json.loads(json.dumps(expected))
        assert set(await store.job_parts(job.id)) == {"0+20", "20+20", "40+20"}


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"runs": 0}, "runs"),
        ({"runs": 1_000_000_000}, "runs"),
        ({"planners": ["best"]}, "planners"),
        ({"planners": ["dwa"]}, "planners"),
        ({"planners": []}, "planners"),
        ({"config": {"solvable": True, "columns": 3, "rows": 6, "potholes": 12, "vehicles": 0}}, "road"),
        ({"config": {"potholes": 5_000}}, "config.potholes"),
        ({"road": "this"}, "road"),
        ({"scenario_name": "flat-earth"}, "scenario_name"),
        ({"scenario_name": "maze", "config": {"potholes": 3}}, "scenario_name"),
        ({"scenario_name": "maze", "find": "worst"}, "scenario_name"),
        ({"scenario_name": "maze", "text": "evaluate A*"}, "scenario_name"),
        ({"scenario_name": "maze", "runs": 0}, "runs"),
        ({"text": "add five potholes"}, "text"),
        ({"text": "evaluate A*", "runs": 5}, "runs"),
        ({"text": "run 100 episodes with DWA"}, "planners"),
    ],
)
async def test_what_cannot_be_run_is_said_before_it_begins(
    running: Service, body: dict[str, Any], field: str
) -> None:
    answer = await running.client.post(ALL, json=body)
    assert answer.status_code == 422, answer.text
    assert field in [each["field"] for each in answer.json()["errors"]]
    assert (await running.client.get(ALL)).json()["items"] == []


async def test_a_full_disk_is_said_before_it_begins(
    running: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def full(*_: object) -> None:
        raise StoreError("the disk is full")

    monkeypatch.setattr(running.store, "create_job", full)
    path = await running.session()
    for answer in (
        await running.client.post(ALL, json={"runs": 5}),
        await running.say(path, "run 5 episodes"),
    ):
        assert answer.status_code == 503
        assert answer.json()["type"] == "/problems/not-saved"


async def test_a_disk_without_room_for_the_figures_is_said_before_it_begins(
    running: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def little() -> int:
        return 20_000_000

    monkeypatch.setattr(running.store, "room", little)
    path = await running.session()
    for answer in (
        await running.client.post(ALL, json={"runs": 1_000_000}),
        await running.say(path, "run 1000000 episodes"),
    ):
        assert answer.status_code == 503
        assert "may take 32 MB, and the disk has 20 MB left" in answer.json()["detail"]
    assert (await running.client.get(ALL)).json()["items"] == []
    assert (await running.client.post(ALL, json={"runs": 5})).status_code == 202


async def test_a_scenario_is_named_by_sentence_and_by_figures(running: Service) -> None:
    said = await running.client.post(ALL, json={"text": "run the gap in the wall scenario 20 times with A*"})
    typed = await running.client.post(
        ALL, json={"runs": 20, "planners": ["astar"], "scenario_name": "Gap in the wall"}
    )
    filed = await running.client.post(
        ALL, json={"runs": 20, "planners": ["astar"], "file": named_scenario("gap-in-the-wall").to_values()}
    )
    found = [await ended(running, each.headers["location"]) for each in (said, typed, filed)]
    assert found[0]["result"] == found[1]["result"] == found[2]["result"]
    assert (found[0]["scenario_name"], found[0]["same_road"]) == ("gap-in-the-wall", True)
    assert "20 runs of “gap-in-the-wall” with A*" in found[0]["title"]
    page = (await running.client.get(f"{said.headers['location']}/report")).text
    assert "Every planner drove the same road" in page


async def test_a_moment_that_was_saved_is_a_road_to_evaluate(running: Service) -> None:
    path = await running.session(config={"vehicles": 4, "potholes": 2}, paused=True, seed=5)
    assert (await running.say(path, "save this as night shift")).status_code == 200
    saved = (await running.state(path))["digest"]
    assert (await running.say(path, "step 3 ticks and remove all potholes")).status_code == 200
    answer = await running.say(
        path, "run the scenario night shift 20 times with A* and tell me how often it crashes"
    )
    assert answer.status_code == 200, answer.text
    (one,) = answer.json()["evaluations"]
    found = await ended(running, one["links"]["self"])
    assert (found["scenario_name"], found["same_road"], found["runs"]) == ("night shift", True, 20)
    body = {
        "runs": 20,
        "planners": ["astar"],
        "session": path.rpartition("/")[2],
        "scenario_name": "night shift",
    }
    typed = await ended(running, (await running.client.post(ALL, json=body)).headers["location"])
    assert typed["result"] == found["result"]
    await running.say(path, "go back to night shift")
    assert (await running.state(path))["digest"] == saved
    here = {**body, "road": "this"}
    here.pop("scenario_name")
    same = await ended(running, (await running.client.post(ALL, json=here)).headers["location"])
    assert same["result"] == found["result"]
    unknown = await running.say(path, 'run the scenario "day shift" 20 times')
    assert unknown.status_code == 422
    assert "night shift, closing-in" in unknown.json()["detail"]


async def test_too_many_that_wait_are_refused(held: Service) -> None:
    answers = [await held.client.post(ALL, json={"runs": 40}) for _ in range(21)]
    assert [each.status_code for each in answers] == [202] * 20 + [429]


async def test_a_session_evaluates_its_own_roads_and_says_so(running: Service) -> None:
    path = await running.session(config={"potholes": 30}, paused=True, seed=None)
    before = (await running.client.get(path)).json()
    answer = await running.say(path, "run 20 episodes with A*")
    assert answer.status_code == 200
    said = answer.json()
    (one,) = said["evaluations"]
    assert said["reply"].startswith("Started 20 runs with A*, with 30 potholes on roads drawn from seed")
    assert "/api" not in said["reply"]  # the link beside it opens the report
    assert one["links"]["report"].endswith("/report")
    found = await ended(running, one["links"]["self"])
    assert (found["config"]["potholes"], found["seed"], found["same_road"]) == (30, before["seed"], False)
    log = (await running.client.get(f"{path}/events")).json()["items"]
    assert log[-1]["text"].startswith("The evaluation is done: A* arrived in")
    assert one["links"]["report"] in log[-1]["text"]
    assert (await running.say(path, "how is the evaluation going?")).json()["reply"] == log[-1]["text"]
    after = (await running.client.get(path)).json()
    assert after["sequence"] == before["sequence"]


async def test_a_dry_run_starts_nothing(running: Service) -> None:
    path = await running.session()
    answer = await running.say(path, "run 20 episodes", dry_run=True)
    assert answer.status_code == 200
    assert answer.json()["evaluations"] == []
    assert "link" not in answer.json()["reply"]
    assert (await running.client.get(ALL)).json()["items"] == []


async def test_beside_a_change_it_is_stored_and_a_restart_starts_it_not_again() -> None:
    store = MemoryStore()
    path = ""
    async for service in started(store):
        path = await service.session(paused=True)
        answer = await service.act(
            path, {"do": "add", "kind": "pothole", "count": 2}, {"do": "evaluate", "runs": 5, "road": "this"}
        )
        assert answer.status_code == 200, answer.text
        (one,) = answer.json()["evaluations"]
        found = await ended(service, one["links"]["self"])
        assert (found["same_road"], found["state"]) == (True, "done")
        digest = (await service.state(path))["digest"]
    async for service in started(store):
        assert (await service.state(path))["digest"] == digest
        assert len((await service.client.get(ALL)).json()["items"]) == 1


async def test_a_road_without_a_way_is_refused_with_the_whole_utterance(running: Service) -> None:
    path = await running.session(config={"columns": 3, "rows": 6, "potholes": 0, "vehicles": 0}, paused=True)
    wall = [
        {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, 3]}} for column in range(3)
    ]
    answer = await running.act(path, *wall, {"do": "evaluate", "road": "this"})
    assert answer.status_code == 422
    assert "no way to the goal" in answer.json()["detail"]
    assert (await running.state(path))["tick"] == 0
    assert (await running.client.get(path)).json()["sequence"] == 0


async def test_one_key_starts_one_evaluation(running: Service) -> None:
    headers = {"Idempotency-Key": "the-same"}
    answers = [await running.client.post(ALL, json={"runs": 5}, headers=headers) for _ in range(2)]
    assert answers[0].json()["id"] == answers[1].json()["id"]
    assert len((await running.client.get(ALL)).json()["items"]) == 1


def test_the_default_road_is_that_of_the_configuration() -> None:
    assert Evaluation(planners=("rules",), episodes=1).config == Config()


async def test_conditions_are_compared_and_each_has_its_episodes(running: Service) -> None:
    text = "run 20 episodes with A* in fog and in clear weather with the camera"
    made = await running.client.post(ALL, json={"text": text, "seed": 3})
    assert made.status_code == 202, made.text
    typed = {"runs": 20, "planners": ["astar"], "config": {"sensor": "camera"}, "seed": 3}
    other = await running.client.post(ALL, json={**typed, "vary": {"weather": ["fog", "clear"]}})
    path = made.headers["location"]
    found = await ended(running, path)
    assert (await ended(running, other.headers["location"]))["result"] == found["result"]
    assert found["title"] == "Evaluation: 20 runs with A*, with the camera, in fog and in clear weather"
    assert (found["runs"], found["done"], found["progress"]) == (20, 40, 1)
    assert found["conditions"] == [{"weather": "fog"}, {"weather": "clear"}]
    assert found["text"][0].startswith("In fog: A* arrived in")
    assert found["text"][1].startswith("In clear weather: A* arrived in")
    page = (await running.client.get(f"{path}/report")).text
    names = set(re.findall(r'id="(episode-\d+)"', page))
    leads = re.findall(r'href="#(episode-\d+)"', page)
    assert len(leads) > 10
    assert set(leads) <= names
    rows = list(csv.DictReader(StringIO((await running.client.get(f"{path}/report?format=csv")).text)))
    assert [row["weather"] for row in rows] == ["fog"] * 20 + ["clear"] * 20
    crashed = sum(row["outcome"] == "crash" for row in rows if row["weather"] == "fog")
    assert found["result"]["cases"][0]["planners"]["astar"]["crashed"]["count"] == crashed


async def test_how_far_it_is_can_be_asked_and_its_end_said(held: Service) -> None:
    path = await held.session()
    assert (
        "No evaluation was asked for"
        in (await held.say(path, "how is the evaluation going?")).json()["reply"]
    )
    (one,) = (await held.say(path, "run 60 episodes with A*")).json()["evaluations"]
    await until_done(held, one["links"]["self"], 20)
    reply = (await held.say(path, "how is the evaluation going?")).json()["reply"]
    assert reply == "33.3 % is done: 20 of 60 runs. (Evaluation: 60 runs with A*.)"
    tried = await held.say(path, "cancel the evaluation", dry_run=True)
    assert tried.status_code == 200
    assert (await held.client.get(one["links"]["self"])).json()["state"] == "running"
    reply = (await held.say(path, "cancel the evaluation")).json()["reply"]
    assert reply.startswith("Cancelled after 20 of 60 runs.")
    assert (await held.client.get(one["links"]["self"])).json()["state"] == "cancelled"
    again = (await held.say(path, "cancel the evaluation")).json()["reply"]
    assert again == "No evaluation of this session is under way."


async def test_which_planner_was_better_is_told_of_the_latest_evaluation(running: Service) -> None:
    path = await running.session()
    asked = "so which was better, Rules or A*?"
    assert "No evaluation was asked for" in (await running.say(path, asked)).json()["reply"]
    (one,) = (await running.say(path, "run 30 episodes with A* and the rule planner")).json()["evaluations"]
    result = (await ended(running, one["links"]["self"]))["result"]
    told = (await running.say(path, "which was better, the rule planner or A*?")).json()["reply"]
    share = {name: result["planners"][name]["arrived"]["count"] for name in ("astar", "priority")}
    (pair,) = result["comparisons"]
    better = "A*" if share["astar"] > share["priority"] else "The rule planner"
    assert pair["settled"] is (f"{better} was better at arriving." in told)
    assert f"{share['priority']} of 30 runs" in told
    assert len(told.split()) <= 60
    assert (await running.say(path, "which planner was better")).json()["reply"] == told
    other = (await running.say(path, "which was better, A* or Dijkstra?")).json()["reply"]
    assert "had no part in it" in other
    (alone,) = (await running.say(path, "run 20 episodes with A*")).json()["evaluations"]
    await ended(running, alone["links"]["self"])
    assert "compared nothing" in (await running.say(path, "who won?")).json()["reply"]


async def test_a_number_of_runs_is_never_left_out(running: Service) -> None:
    path = await running.session()
    for said, runs in (
        ("run it 40 times and give me the success rate", 40),
        ("how often do you crash in 30 runs?", 30),
        ("what is the success rate if you do it 25 times?", 25),
    ):
        (action,) = (await running.say(path, said, dry_run=True)).json()["actions"]
        assert (action["do"], action["runs"]) == ("evaluate", runs), said


async def test_with_a_key_the_link_opens_its_report_and_nothing_else() -> None:
    app = create_app(
        Settings(database="memory:", api_key=SecretStr("k" * 20)),
        store=MemoryStore(),
        language=Language.load("en"),
        clock=HandClock(),
        make_executor=InProcess,
    )
    bearer = {"Authorization": f"Bearer {'k' * 20}"}
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        made = await client.post(ALL, json={"runs": 3}, headers=bearer)
        await app.state.context.jobs.wait(made.json()["id"])
        found = (await client.get(made.headers["location"], headers=bearer)).json()
        report, ticket = found["links"]["report"].split("?ticket=")
        assert (await client.get(report)).status_code == 401
        opened = await client.get(found["links"]["report"])
        assert (opened.status_code, opened.headers["content-type"]) == (200, "text/html; charset=utf-8")
        for other in (found["links"]["self"], ALL, report.replace(made.json()["id"], "another")):
            assert (await client.get(f"{other}?ticket={ticket}")).status_code == 401, other
        for wrong in (ticket[:-1], f"9{ticket}", "", "x-y"):
            assert (await client.get(f"{report}?ticket={wrong}")).status_code == 401, wrong


async def test_a_scenario_file_is_evaluated_and_its_flaws_are_named(running: Service) -> None:
    file = named_scenario("growing-traffic").to_values()
    made = await running.client.post(ALL, json={"file": file, "runs": 4, "planners": ["astar"], "seed": 2})
    assert made.status_code == 202, made.text
    found = await ended(running, made.headers["location"])
    spec = evaluation_of_scenario(named_scenario("growing-traffic"), 4, ("astar",), 2)
    assert found["result"] == json.loads(json.dumps(evaluate(spec)))
    assert "with a rule" in found["title"]
    for wrong, field in (
        ({"file": {**file, "version": 2}}, "file.version"),
        ({"file": {**file, "config": {"potholes": -1}}}, "file.config.potholes"),
        ({"file": file, "text": "run 5 episodes"}, "text"),
        ({"file": file, "runs": 0}, "runs"),
        ({"file": {}}, "file.name"),
    ):
        answer = await running.client.post(ALL, json=wrong)
        assert answer.status_code == 422, answer.text
        assert field in [each["field"] for each in answer.json()["errors"]]


async def test_a_search_for_failures_is_asked_about_and_cancelled_in_the_same_way(held: Service) -> None:
    path = await held.session()
    assert (await held.say(path, "find the hardest scenario")).status_code == 200
    reply = (await held.say(path, "how is the search going?")).json()["reply"]
    assert "%" in reply or "waits" in reply
    reply = (await held.say(path, "cancel the search")).json()["reply"]
    assert reply.startswith("Cancelled after")


async def test_a_success_map_is_asked_for_in_a_sentence_and_in_figures(running: Service) -> None:
    small = {"columns": 5, "rows": 10, "planner": "priority"}
    path = await running.session(config=small, paused=True)
    said = await running.say(path, "show me a success map of potholes and traffic with 2 runs")
    assert said.status_code == 200, said.text
    assert said.json()["reply"].startswith("Started 2 runs with Priority rules, on 5 lanes")
    over = "in each cell of a map over potholes and cars"
    assert over in said.json()["reply"]
    body = {"map": ["potholes", "vehicles"], "runs": 2, "config": small, "planners": ["priority"]}
    made = await running.client.post(ALL, json=body | {"vary": {"vehicles": [0, 4]}})
    assert made.status_code == 202, made.text
    whole = await ended(running, said.json()["evaluations"][0]["links"]["self"])
    assert [len(each) for each in whole["result"]["map"]["values"]] == [6, 6]
    found = await ended(running, made.json()["links"]["self"])
    assert found["result"]["map"]["values"][1] == [0, 4]
    assert found["title"] == f"Evaluation: 2 runs with Priority rules, on 5 lanes, on 10 rows, {over}"
    typed = await running.act(path, {"do": "evaluate", "runs": 2, "map": ["potholes", "vehicles"]})
    assert typed.status_code == 200, typed.text
    page = (await running.client.get(f"{made.json()['links']['self']}/report")).text
    assert "Success map: Priority rules" in page
    for wrong in (
        {"map": ["potholes"]},
        {"map": ["potholes", "weather"]},
        {"map": ["potholes", "vehicles"], "vary": {"weather": ["fog", "rain"]}},
        {"map": ["potholes", "vehicles"], "vary": {"potholes": list(range(40))}},
        {"map": ["potholes", "vehicles"], "find": "worst"},
        {"map": ["potholes", "vehicles"], "runs": 1_000_000},
    ):
        assert (await running.client.post(ALL, json=wrong)).status_code == 422, wrong
