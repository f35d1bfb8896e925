"""A shard: the ordinary service over its part of the sessions, in a thread of a process that Ray started.

The process's main thread belongs to Ray. It loads everything that a service needs before it is told which
shard it is, so that a spare one takes the place of one that died at once. When the service ends although
nobody stopped it, the process ends, and Ray starts another.
"""

from __future__ import annotations

import asyncio
import os
import socket
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Final

import structlog
import uvicorn
from fastapi import FastAPI

from service import gc_tuning as garbage
from service import logging_setup as logs
from service.app import create_app
from service.cli.serve import SWITCH_S, ServiceServer, serve_app, server_config, warmed
from service.cluster.forwarded import ForwardedOnly
from service.cluster.places import Place
from service.settings import Settings
from service.sharding import Shard
from service.shutdown import Deadline
from service.store import Store, StoreError, open_store
from service.version import VERSION
from service.warm_up import prepare
from sim.config import Config

_LOG = structlog.get_logger(__name__)

RETRY_S: Final = 0.25
"""Pause before the database is tried again, while its server or the shard's own lock is not free."""

STOP_S: Final = 5.0
"""How long a shard that was told to stop is waited for."""


class ShardProcess:
    """Runs one shard, once it is told which. Its methods are for any thread but the service's own."""

    def __init__(self, settings: Settings, token: str, host: str) -> None:
        """Get ready. `token`: what the entry shows; `host`: the address at which it reaches the shard."""
        logs.configure(settings)
        self._settings, self._token = settings, token
        self._listener = socket.create_server(
            (host, 0), family=socket.AF_INET6 if ":" in host else socket.AF_INET
        )
        self._ready = threading.Event()
        self._server: uvicorn.Server | None = None
        self._stopping = False
        with garbage.no_collection():
            open_store(settings.database)  # loads the driver
            app = create_app(settings.model_copy(update={"database": "memory:"}))
            with ThreadPoolExecutor(1) as alone:  # Ray has a loop of its own in this thread
                alone.submit(asyncio.run, _rehearse(app)).result()

    def serve(self, shard: Shard, tell_others: Callable[[], None]) -> Place:
        """Become a shard, and return where it listens; waits for the database if need be.

        `tell_others`: called after a phrase was taught or forgotten here.
        """
        store = open_store(self._settings.database, shard)
        app = create_app(self._settings, store=store, shard=shard)
        app.add_middleware(ForwardedOnly, token=self._token)
        app.state.aliases.on_change = tell_others
        self._app = app
        self._thread = threading.Thread(target=self._run, args=(app, store, shard), name="shard", daemon=True)
        self._thread.start()
        self._ready.wait()
        host, port = self._listener.getsockname()[:2]
        return Place(host, port, os.getpid(), VERSION)

    def wait(self) -> None:
        """Return when it was stopped; never if it dies."""
        self._thread.join()

    def stop(self) -> None:
        """Store where clocks stand and end."""
        self._stopping = True
        if self._server is not None:
            self._server.should_exit = True
            self._thread.join(STOP_S)

    def reload_phrases(self) -> None:
        """Read the taught phrases again: another shard has changed them."""
        if self._ready.is_set():
            asyncio.run_coroutine_threadsafe(self._app.state.aliases.open(), self._loop)

    def _run(self, app: FastAPI, store: Store, shard: Shard) -> None:
        deadline = Deadline()
        try:
            config = server_config(app, self._settings, behind_entry=True)
            sys.setswitchinterval(SWITCH_S)
            with asyncio.Runner(loop_factory=config.get_loop_factory()) as runner:
                runner.run(self._serve(config, store, deadline))
        except BaseException as error:
            _LOG.error("a shard ended", shard=shard.number, exc_info=error)
        finally:
            deadline.lift()
            if not self._stopping:
                os._exit(1)

    async def _serve(self, config: uvicorn.Config, store: Store, deadline: Deadline) -> None:
        self._loop = asyncio.get_running_loop()
        await _open(store)
        await serve_app(config, store, self._listener, deadline, self._on_ready)

    def _on_ready(self, server: ServiceServer) -> None:
        self._server = server
        self._ready.set()


async def _rehearse(app: FastAPI) -> None:
    """Load and build all that a service needs, with an application that serves nobody: it stays loaded."""
    context = app.state.context
    async with app.router.lifespan_context(app):
        await warmed(app)
        await prepare(context.interpreter.languages)
        await context.manager.create(None, Config(), paused=True)


async def _open(store: Store) -> None:
    """Open the store as soon as that can be: the locks of the process before may take a moment to go."""
    while True:
        try:
            await store.open()
        except StoreError as error:
            _LOG.warning("a shard waits for the database", error=str(error))
            await asyncio.sleep(RETRY_S)
        else:
            return
