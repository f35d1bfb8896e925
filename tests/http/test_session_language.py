"""A session made in a language speaks it everywhere: reply, log, narration, refusals; and keeps it."""

from __future__ import annotations

import re
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx

from service.app import create_app
from service.settings import Settings
from tests.support.fakes import HandClock

Json = dict[str, Any]
ENGLISH = re.compile(
    r"\b(the|and|ahead|pothole|potholes|because|forward|left|right|there|is|are|with|not|lane|row|to)\b", re.I
)
CONFIG = {"seed": 5, "planner": "rules", "potholes": 6, "vehicles": 4}


class Http:
    """A client of one service."""

    def __init__(self, client: httpx.AsyncClient) -> None:
        self._client = client

    async def get(self, path: str) -> httpx.Response:
        return await self._client.get(f"/api/v1{path}")

    async def post(self, path: str, body: Json) -> httpx.Response:
        return await self._client.post(f"/api/v1{path}", json=body)


@asynccontextmanager
async def running() -> AsyncIterator[Http]:
    """A service with all its languages."""
    app = create_app(Settings(database="memory:"), clock=HandClock())
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Http(client)


def check_german(*texts: str | None) -> None:
    for text in texts:
        assert text
        assert not ENGLISH.search(re.sub(r"\b\w+-\d+\b", "", text)), text


async def test_all_that_is_said_is_in_the_language_of_the_session() -> None:
    async with running() as service:
        session = (
            await service.post("/sessions", {"language": "de", "paused": True, "config": CONFIG})
        ).json()
        assert session["language"] == "de"
        own = session["links"]["self"].removeprefix("/api/v1")
        said = (await service.post(f"{own}/commands", {"text": "füge fünf Schlaglöcher hinzu"})).json()
        check_german(said["reply"])
        typed = {"actions": [{"do": "remove", "kind": "pothole", "count": 1, "where": {"nearest": True}}]}
        check_german((await service.post(f"{own}/actions", typed)).json()["reply"])
        stepped = (await service.post(f"{own}/step", {"ticks": 60})).json()
        check_german(*(each["narration"] for each in stepped["decisions"]))
        log = (await service.get(f"{own}/events")).json()["items"]
        assert len(log) >= 3
        check_german(*(line["text"] for line in log))
        decided = (await service.get(f"{own}/decisions")).json()["items"]
        check_german(*(each["narration"] for each in decided))
        asked = (await service.post(f"{own}/ask", {"question": "warum hast du das gemacht?"})).json()
        check_german(asked["question"], asked["text"])
        english = (await service.post(f"{own}/ask", {"question": "where are you?", "language": "en"})).json()
        assert ENGLISH.search(english["text"])
        other = (await service.post(f"{own}/commands", {"text": "add a pothole", "language": "en"})).json()
        assert other["reply"].startswith("Added")
        check_german((await service.get(f"{own}/events")).json()["items"][-1]["text"])
        for path, body in (
            ("commands", {"text": "dreh dich im Kreis"}),
            ("commands", {"text": "entferne 50 Barrieren"}),
            ("actions", {"actions": [{"do": "remove", "kind": "barrier", "count": 99}]}),
            ("actions", {"actions": [{"do": "rewind", "ticks": 5000}]}),
            ("actions", {"actions": [{"do": "load", "name": "x"}]}),
            (
                "counterfactual",
                {"at_tick": 0, "actions": [{"do": "set", "parameter": "target_speed_kmh", "value": 40}]},
            ),
        ):
            answer = await service.post(f"{own}/{path}", body)
            assert answer.status_code in (409, 422), answer.text
            check_german(answer.json()["detail"])


async def test_forks_recordings_and_links_keep_the_language() -> None:
    async with running() as service:
        session = (
            await service.post("/sessions", {"language": "de", "paused": True, "config": CONFIG})
        ).json()
        own = session["links"]["self"].removeprefix("/api/v1")
        fork = (await service.post(f"{own}/forks", {})).json()
        recording = (await service.get(f"{own}/recording")).json()
        replayed = (await service.post("/sessions", {"recording": recording})).json()
        link = (await service.get(f"{own}/link")).json()["link"]
        linked = (await service.post("/sessions", {"link": link})).json()
        assert [each["language"] for each in (fork, replayed, linked)] == ["de"] * 3
        plain = (await service.post("/sessions", {"paused": True})).json()
        recording = (await service.get(f"/sessions/{plain['id']}/recording")).json()
        assert plain["language"] == "en"
        assert "language" not in recording
        refused = await service.post("/sessions", {"language": "tlh"})
        assert refused.status_code == 422
