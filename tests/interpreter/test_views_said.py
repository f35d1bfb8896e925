"""Views shown and hidden by sentence: every page that watches follows, and the session stays as it is."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from typing import Any

import httpx
import pytest
from websockets.asyncio.client import ClientConnection, connect

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.live_server import running

Json = dict[str, Any]


class Watched:
    """One session with the real language, and a stream that watches it."""

    def __init__(self, client: httpx.AsyncClient, path: str, stream: ClientConnection) -> None:
        self.client, self.path, self.stream = client, path, stream

    async def say(self, text: str, **more: Any) -> httpx.Response:
        return await self.client.post(f"{self.path}/commands", json={"text": text, **more})

    async def heard(self) -> Json:
        message: Json = json.loads(await asyncio.wait_for(self.stream.recv(), 60))
        return message

    async def look(self, what: str = "") -> Json:
        return (await self.client.get(f"{self.path}{what}")).json()  # type: ignore[no-any-return]


@pytest.fixture
async def watched() -> AsyncIterator[Watched]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), clock=HandClock())
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        path = (await client.post("/api/v1/sessions", json={"seed": 5})).headers["location"]
        async with connect(f"{service.ws}{path}/stream") as stream:
            one = Watched(client, path, stream)
            assert (await one.heard())["type"] == "hello"
            yield one


@pytest.mark.parametrize(
    ("text", "views", "reply"),
    [
        ("show the occupancy matrix", {"occupancy": True}, "The occupancy matrix is shown."),
        ("hide the log", {"log": False}, "The log is hidden."),
        ("hide the path", {"path": False}, "The path is hidden."),
        ("pothole map on", {"potholes": True}, "The pothole map is shown."),
        ("hide the metrics", {"metrics": False}, "The metrics are hidden."),
        (
            "show the plan and hide the schematic",
            {"plan": True, "schematic": False},
            "The plan is shown. The",
        ),
    ],
)
async def test_watchers_are_told_and_nothing_is_changed(
    watched: Watched, text: str, views: Json, reply: str
) -> None:
    before, log = await watched.look(), await watched.look("/events")
    answer = await watched.say(text)
    assert answer.status_code == 200, answer.text
    assert answer.json()["reply"].startswith(reply)
    assert (answer.json()["changes"], answer.json()["sequence"]) == ([], 0)
    told = await watched.heard()
    assert (told["type"], told["views"], told["text"]) == ("changed", views, text)
    assert (told["changes"], told["events"], told["sequence"]) == ([], [], 0)
    assert (await watched.look(), await watched.look("/events")) == (before, log)
    assert (await watched.look("/recording"))["entries"] == []


async def test_it_is_no_step_to_undo_and_a_dry_run_is_told_to_nobody(watched: Watched) -> None:
    await watched.say("add five potholes")
    assert "views" not in await watched.heard()
    await watched.say("hide the log", dry_run=True)
    await watched.say("hide the plan")
    assert (await watched.heard())["views"] == {"plan": False}
    undone = await watched.say("undo")
    assert [change["path"] for change in undone.json()["changes"]] == ["potholes"]


async def test_said_with_a_change_it_is_kept_with_it_and_replays(watched: Watched) -> None:
    said = await watched.say("hide the log and add five potholes")
    assert said.json()["reply"].startswith("The log is hidden. Added 5 potholes")
    told = await watched.heard()
    assert (told["views"], told["sequence"]) == ({"log": False}, 1)
    recording = await watched.look("/recording")
    again = await watched.client.post("/api/v1/sessions", json={"recording": recording})
    assert again.status_code == 201, again.text
    here, there = (
        await watched.look("/state"),
        (await watched.client.get(again.headers["location"] + "/state")).json(),
    )
    assert here["digest"] == there["digest"]


async def test_there_are_no_sensors_to_show(watched: Watched) -> None:
    answer = await watched.say("show the sensors")
    assert answer.status_code == 422
    assert answer.json()["type"] == "/problems/not-available"
    assert "is not available yet" in answer.json()["detail"]
