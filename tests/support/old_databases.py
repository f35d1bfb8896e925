"""Databases of older versions of the schema."""

from __future__ import annotations

from pathlib import Path

import httpx

from service.app import create_app
from service.settings import Settings

DATA = Path(__file__).parent.parent / "faults" / "data"


async def state_of(url: str, session: str) -> httpx.Response:
    app = create_app(Settings(database=url))
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://service") as client,
    ):
        return await client.get(f"/api/v1/sessions/{session}/state")
