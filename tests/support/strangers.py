"""Requests of strangers, and what each of them must be told."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock

KEY = "a-key-of-this-test"


BEARER = {"Authorization": f"Bearer {KEY}"}


SESSIONS = "/api/v1/sessions"


@asynccontextmanager
async def asked(*, grammar: bool = False, **settings: Any) -> AsyncIterator[httpx.AsyncClient]:
    app = create_app(
        Settings(database="memory:", **settings),
        store=MemoryStore(),
        language=None if grammar else FewSentences(),
        clock=HandClock(),
    )
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://127.0.0.1") as client,
    ):
        yield client


def assert_refused(answer: httpx.Response, status: int, slug: str) -> None:
    assert (answer.status_code, answer.json()["type"]) == (status, f"/problems/{slug}"), answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert answer.headers["x-request-id"]
