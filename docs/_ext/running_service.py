"""A service in memory, which the generated pages ask for its documents."""

from __future__ import annotations

import asyncio
import logging
from functools import cache

import httpx
from fastapi import FastAPI

from service.app import create_app
from service.settings import Settings

logging.getLogger("httpx").setLevel(logging.WARNING)


@cache
def app() -> FastAPI:
    """Returns the service, made once for all pages."""
    return create_app(Settings(database="memory:"))


def get(path: str) -> httpx.Response:
    """Asks the service without a network. Raises `httpx.HTTPStatusError` if it refuses."""

    async def ask() -> httpx.Response:
        transport = httpx.ASGITransport(app())
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return (await client.get(path)).raise_for_status()

    return asyncio.run(ask())
