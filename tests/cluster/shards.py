"""An entry and two shards over one store in memory, on real ports inside the test's loop: all but Ray."""

from __future__ import annotations

import asyncio
import os
import socket
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass
from typing import Any

import httpx
import uvicorn

from service.app import create_app
from service.cli.serve import server_config
from service.cluster.entry import Entry
from service.cluster.forwarded import ForwardedOnly
from service.cluster.places import Place, Places
from service.settings import Settings
from service.sharding import Shard
from service.store import MemoryStore
from service.version import VERSION
from tests.support.live_server import Running, running

TOKEN = "token-of-the-tests"
COUNT = 2


@dataclass
class Cluster:
    """What a test needs of it."""

    client: httpx.AsyncClient
    places: Places
    shards: list[Running]
    apps: list[Any]
    url: str

    async def kill(self, shard: int) -> None:
        """Nobody listens for it any more; the entry is told nothing."""
        await self.shards[shard].stop()

    async def create(self, shard: int | None = None, **body: Any) -> tuple[str, int]:
        """The address of a new session and its shard; of this shard, if one is named."""
        while True:
            made = await self.client.post("/api/v1/sessions", json={"seed": 1, "paused": True, **body})
            assert made.status_code == 201, made.text
            lives = int(made.headers["roadtalk-shard"])
            if shard in (None, lives):
                return made.headers["location"], lives


class _Server(uvicorn.Server):
    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self.listening = asyncio.Event()

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self.listening.set()


@asynccontextmanager
async def cluster(**given: Any) -> AsyncIterator[Cluster]:
    """Two shards, and an entry before them."""
    settings = Settings(database="memory:", workers=COUNT, **given)
    store, places = MemoryStore(), Places(COUNT)
    async with AsyncExitStack() as stack:
        shards, apps = [], []
        for number in range(COUNT):
            app = create_app(settings, store=store, shard=Shard(number, COUNT))
            app.add_middleware(ForwardedOnly, token=TOKEN)
            shard = await stack.enter_async_context(running(app, settings, behind_entry=True))
            places.set(number, Place("127.0.0.1", shard.port, os.getpid(), VERSION))
            shards.append(shard)
            apps.append(app)
        entry = Entry(places, TOKEN, settings)
        stack.push_async_callback(entry.aclose)
        listener = stack.enter_context(socket.create_server(("127.0.0.1", 0)))
        server = _Server(server_config(entry, settings, lifespan="off"))
        task = asyncio.create_task(server._serve([listener]))
        await asyncio.wait_for(server.listening.wait(), 60)
        url = f"http://127.0.0.1:{listener.getsockname()[1]}"
        try:
            async with httpx.AsyncClient(base_url=url, timeout=60) as client:
                yield Cluster(client, places, shards, apps, url)
        finally:
            server.should_exit = True
            await asyncio.wait_for(task, 60)
