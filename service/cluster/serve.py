"""`serve --workers N`: shards started by Ray, and the entry in front of them in this process."""

from __future__ import annotations

import asyncio
import secrets
import socket
import sys
from collections.abc import Callable
from importlib.util import find_spec
from typing import TYPE_CHECKING

import uvicorn

from service.cli.serve import SWITCH_S, server_config
from service.cluster.entry import Entry
from service.sessions.persistence.seal import SECRET
from service.settings import Settings
from service.store import open_store

if TYPE_CHECKING:
    from service.cluster.ray_shards import RayShards

_POSTGRES = ("postgresql://", "postgresql+asyncpg://")


def missing_for_shards(settings: Settings) -> str | None:
    """What several processes need and is not there, as a sentence; None where nothing is missing."""
    if find_spec("ray") is None:
        return "More than one worker needs Ray, which is not installed: pip install 'roadtalk[cluster]'."
    if not settings.database.startswith(_POSTGRES):
        return (
            "More than one worker needs PostgreSQL (ROADTALK_DATABASE=postgresql://<host>/<name>): "
            "a SQLite file and memory belong to one process."
        )
    return None


def serve_shards(
    settings: Settings, listener: socket.socket, on_ready: Callable[[socket.socket], None]
) -> None:
    """Run the service until it is told to stop. Raises `StoreError` or `ShardsNotStartedError`."""
    from service.cluster.ray_shards import RayShards

    asyncio.run(_prepare(settings))
    token = secrets.token_urlsafe(32)
    shards = RayShards(settings, token)
    try:
        asyncio.run(_serve(settings, listener, shards, token, on_ready))
    finally:
        shards.stop()


async def _prepare(settings: Settings) -> None:
    """Bring the database up to date, alone: so no two shards do, and no other service uses it."""
    store = open_store(settings.database)
    await store.open()
    try:
        await store.secret(SECRET)
    finally:
        await store.close()


async def _serve(
    settings: Settings,
    listener: socket.socket,
    shards: RayShards,
    token: str,
    on_ready: Callable[[socket.socket], None],
) -> None:
    watching = asyncio.create_task(shards.watch())
    up = asyncio.create_task(shards.wait_until_up())
    entry = Entry(shards.places, token, settings)
    try:
        await asyncio.wait((watching, up), return_when=asyncio.FIRST_COMPLETED)
        if watching.done() and (failed := watching.exception()) is not None:
            raise failed.exceptions[0] if isinstance(failed, ExceptionGroup) else failed
        server = _EntryServer(server_config(entry, settings, lifespan="off"), lambda: on_ready(listener))
        await server.serve(sockets=[listener])
    finally:
        up.cancel()
        watching.cancel()
        await asyncio.wait((watching, up))
        await entry.aclose()


class _EntryServer(uvicorn.Server):
    """Says when it is ready, not before."""

    def __init__(self, config: uvicorn.Config, on_ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to listen, then say so."""
        sys.setswitchinterval(SWITCH_S)
        await super().startup(sockets)
        if self.started:
            self._on_ready()
