"""Ending a session while something is being done to it: one after the other, and each is told the truth."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from service.store.base import EntryRecord, StoredResponse
from tests.support.fakes import FewSentences, HandClock


class HeldStore(MemoryStore):
    """Keeps a change when it is let."""

    def __init__(self) -> None:
        super().__init__()
        self.reached = asyncio.Event()
        self.let = asyncio.Event()

    async def append(self, session_id: str, entry: EntryRecord, *answers: StoredResponse) -> None:
        self.reached.set()
        await self.let.wait()
        await super().append(session_id, entry, *answers)


@pytest.fixture
async def store() -> HeldStore:
    return HeldStore()


@pytest.fixture
async def client(store: HeldStore) -> AsyncIterator[httpx.AsyncClient]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=store, language=FewSentences(), clock=HandClock())
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield client


@pytest.mark.parametrize("meant", [{}, {"If-Match": "*"}])
async def test_what_is_being_done_is_done_before_the_end(
    client: httpx.AsyncClient, store: HeldStore, meant: dict[str, str]
) -> None:
    path = (await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})).headers["location"]
    five = {"text": "add five potholes"}
    doing = asyncio.create_task(client.post(f"{path}/commands", json=five))
    await store.reached.wait()
    ending = asyncio.create_task(client.delete(path, headers=meant))
    late = asyncio.create_task(client.post(f"{path}/commands", json=five))
    assert (await client.get(path)).status_code == 200  # asked last: the others wait by now
    assert not ending.done()
    store.let.set()
    assert (await doing).status_code == 200
    assert (await ending).status_code == 204
    assert (await late).status_code == 404
    assert (await client.get(path)).status_code == 404
