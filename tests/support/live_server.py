"""The service on a real port inside the test's loop, for what only a socket can show."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass

import uvicorn
from fastapi import FastAPI

from service.cli.serve import server_config
from service.settings import Settings

SMALL_BYTES = 16_384
"""Size of socket buffers."""


@dataclass
class Running:
    """Where it is, and the server itself."""

    port: int
    server: uvicorn.Server
    task: asyncio.Task[None]

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def ws(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    async def stop(self) -> None:
        self.server.should_exit = True
        await asyncio.wait_for(self.task, 60)


class _Ready(uvicorn.Server):
    """Tells when it listens; leaves the test's signals alone."""

    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self.listening = asyncio.Event()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self.config.app.state.context.event_streams.stop()  # type: ignore[union-attr]
        await super().shutdown(sockets)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self.listening.set()


@asynccontextmanager
async def running(app: FastAPI, settings: Settings, *, behind_entry: bool = False) -> AsyncIterator[Running]:
    """The application as `roadtalk serve` runs it."""
    listener = socket.socket()
    # Small buffers, inherited by connections: a reader that stops reading is soon felt.
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SMALL_BYTES)
    listener.bind(("127.0.0.1", 0))
    server = _Ready(server_config(app, settings, behind_entry=behind_entry))
    task = asyncio.create_task(server._serve([listener]))
    await asyncio.wait_for(server.listening.wait(), 60)
    service = Running(listener.getsockname()[1], server, task)
    try:
        yield service
    finally:
        await service.stop()
        listener.close()
