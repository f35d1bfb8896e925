"""Databases and recordings that older versions made."""

from __future__ import annotations

import json
import shutil
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any

import httpx

from service.app import create_app
from service.http.session_json import PREFIX
from service.settings import Settings
from sim.session.timeline import Timeline

ROOT = Path(__file__).parents[1] / "data"


Json = dict[str, Any]


def kept(version: str, *parts: str) -> Json:
    """What a file of a version's folder holds."""
    *folders, name = parts
    return dict(json.loads(ROOT.joinpath(version, *folders, f"{name}.json").read_text()))


class Opened:
    """A service with sessions of before, and what is asked of it."""

    def __init__(self, client: httpx.AsyncClient, manager: Any) -> None:
        self.client = client
        self._manager = manager

    async def make(self, **body: Any) -> Json:
        made = await self.client.post(f"{PREFIX}/sessions", json=body)
        assert made.status_code == 201, made.text
        return dict(made.json())

    async def timeline(self, session: str) -> Timeline:
        return (await self._manager.get(session)).timeline.copy()  # type: ignore[no-any-return]

    async def ask(self, session: str, part: str, **body: Any) -> Json:
        path = f"{PREFIX}/sessions/{session}/{part}"
        answer = await (self.client.post(path, json=body) if body else self.client.get(path))
        assert answer.is_success, answer.text
        return dict(answer.json())


@asynccontextmanager
async def opened(database: str = "memory:") -> AsyncIterator[Opened]:
    app = create_app(Settings(database=database))
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        yield Opened(client, app.state.context.manager)


@contextmanager
def copied(version: str, folder: Path) -> Iterator[Path]:
    """A copy of a version's database, which itself stays as it is."""
    original, copy = ROOT / version / "kept.sqlite", folder / "kept.sqlite"
    before = original.read_bytes()
    shutil.copy(original, copy)
    yield copy
    assert original.read_bytes() == before
