"""The service built inside the test, with a store, a language and a clock that stand still."""

from __future__ import annotations

from collections.abc import AsyncIterator
from dataclasses import dataclass

import httpx
import pytest
from fastapi import FastAPI

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock

Json = dict[str, object]


@dataclass
class Service:
    """An application and a client of it."""

    app: FastAPI
    client: httpx.AsyncClient
    clock: HandClock
    store: MemoryStore

    async def session(self, **body: object) -> str:
        """A new session's path; seed 7 unless another is said."""
        answer = await self.client.post("/api/v1/sessions", json={"seed": 7, **body})
        assert answer.status_code == 201, answer.text
        return str(answer.headers["location"])

    async def say(self, path: str, text: str, **more: object) -> httpx.Response:
        return await self.client.post(f"{path}/commands", json={"text": text, **more})

    async def act(self, path: str, *actions: Json) -> httpx.Response:
        return await self.client.post(f"{path}/actions", json={"actions": actions})

    async def state(self, path: str) -> dict[str, object]:
        return (await self.client.get(f"{path}/state")).json()  # type: ignore[no-any-return]


@pytest.fixture
def settings() -> Settings:
    return Settings(database="memory:")


@pytest.fixture
async def service(settings: Settings) -> AsyncIterator[Service]:
    clock, store = HandClock(), MemoryStore()
    app = create_app(settings, store=store, language=FewSentences(), clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)
