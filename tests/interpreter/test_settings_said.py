"""Planners, preferences and settings, said in sentences to the service."""

from __future__ import annotations

import re
from collections.abc import AsyncIterator

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.service import Service


@pytest.fixture
async def talking(settings: Settings) -> AsyncIterator[Service]:
    """The service with the real language."""
    clock, store = HandClock(), MemoryStore()
    app = create_app(settings, store=store, clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("use A*", "The planner: Rules → A*."),
        ("switch to dijkstra", "The planner: Rules → Dijkstra."),
        ("heavy traffic", "Traffic is heavy now. On this road now: cars"),
        ("set the spawn probability to 0.4", "It shows from the next road on."),
        ("raise the safety buffer by one", "The safety buffer: 1 cell of distance → 2 cells of distance."),
        (
            "steer clear of potholes",
            "From now on I keep away from potholes. But the planner “Rules” does not weigh",
        ),
        ("set the sensor range to 40 m", "The sensor range: 150 m → 40 m."),
        ("set rows to 40", "The number of rows: 30 → 40. A new road"),
        ("set the slip probability to 10 %", "The slip probability: 0 % → 10 %."),
        ("set the sensor latency to 1", "The sensor latency: 0 ticks → 1 tick."),
        (
            "set the daily traffic curve to 1",
            "The daily traffic curve: 0 % → 100 %. It shows from the next road on.",
        ),
    ],
)
async def test_what_is_set_is_said(talking: Service, text: str, reply: str) -> None:
    path = await talking.session(paused=True)
    before = await talking.state(path)
    answer = await talking.say(path, text)
    assert answer.status_code == 200, answer.text
    assert reply in answer.json()["reply"]
    undone = await talking.say(path, "undo that")
    assert undone.status_code == 200, undone.text
    assert (await talking.state(path))["digest"] == before["digest"]


@pytest.mark.parametrize(
    "text", ["set the sensor range to 4000 m", "use the learned planner", "set courtesy to 300 %"]
)
async def test_what_cannot_be_set_changes_nothing(talking: Service, text: str) -> None:
    path = await talking.session(paused=True)
    before = (await talking.client.get(path)).json()
    answer = await talking.say(path, text)
    assert answer.status_code == 422, answer.text
    assert (await talking.client.get(path)).json()["config"] == before["config"]


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "bfs"])
async def test_a_weighing_planner_says_what_its_moves_cost(talking: Service, planner: str) -> None:
    path = await talking.session(paused=True, planner=planner, seed=3, config={"potholes": 40})
    assert (await talking.act(path, {"do": "step", "ticks": 12})).status_code == 200
    for tick in range(12):
        answer = await talking.say(path, f"why did you do that at tick {tick}?")
        assert answer.status_code == 200, answer.text
        said = answer.json()["answers"][0] if "answers" in answer.json() else answer.json()["answer"]
        assert re.search(r"the goal|the best way I know|costs as much as", said["text"]), said["text"]
        assert "first choice" not in said["text"]
        not_left = await talking.say(path, f"why not left at tick {tick}?")
        assert not_left.status_code == 200, not_left.text


async def test_a_road_on_which_moves_slip_is_told_as_one(talking: Service) -> None:
    path = await talking.session(paused=True, config={"planner": "priority", "potholes": 12})
    for text in ("make it snow", "set the slip probability to 60 %"):
        assert (await talking.say(path, text)).status_code == 200
    sure = (await talking.say(path, "how sure are you?")).json()["reply"]
    assert "counted both ways" in sure
    await talking.say(path, "step 30 times")
    log = (await talking.client.get(f"{path}/events")).json()
    assert "slipped" in str(log)


async def test_a_new_road_tells_the_settings_that_it_puts_back(talking: Service) -> None:
    path = await talking.session()
    await talking.say(path, "use A*")
    await talking.say(path, "set the weather to fog")
    told = (await talking.say(path, "make a maze")).json()["reply"]
    assert "The planner: A* → Rules." in told
    assert "The weather: fog → clear." in told
    again = (await talking.say(path, "make a maze with A*")).json()["reply"]
    assert "The planner" not in again
