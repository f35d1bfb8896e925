"""`serve`: the service and its page, until it is told to stop."""

from __future__ import annotations

import asyncio
import os
import socket
import sys
from collections.abc import Callable
from typing import Annotated, Literal, NoReturn, cast

import typer
import uvicorn
from fastapi import FastAPI
from pydantic import ValidationError
from starlette.types import ASGIApp, Message, Scope

from service import gc_tuning as garbage
from service import logging_setup as logs
from service.app import create_app
from service.cluster.places import ShardsNotStartedError
from service.env_check import strays
from service.grammar import LanguageDataError
from service.http.protocol import protocol_options
from service.llm import MissingExtraError
from service.llm.failures import PromptError
from service.security.guard import exposure_problem
from service.settings import Settings
from service.shutdown import Deadline, stop_when_hung_up
from service.store import Store, StoreError, open_store
from service.warm_up import warm_up

STOP_S = 1
"""How long a stopping service waits for requests under way."""

SWITCH_S = 0.0005
"""How long a thread that computes keeps the interpreter from the event loop."""


def _default(setting: str) -> str:
    """A setting's default, for help: the option itself has none, so that the environment is heard."""
    return str(Settings.model_fields[setting].default)


def serve(
    host: Annotated[
        str | None, typer.Option(help="Address to listen on.", show_default=_default("host"))
    ] = None,
    port: Annotated[
        int | None,
        typer.Option(help="Port to listen on; 0 takes a free one.", show_default=_default("port")),
    ] = None,
    database: Annotated[
        str | None, typer.Option(help="Where sessions are kept.", show_default=_default("database"))
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            help="Processes that hold sessions; more than 1 need PostgreSQL and the extra 'cluster'.",
            show_default=_default("workers"),
        ),
    ] = None,
) -> None:
    """Run the service and its page until it is told to stop (Ctrl-C).

    Options win over the environment (ROADTALK_HOST, ROADTALK_PORT,
    ROADTALK_DATABASE). One process holds all sessions unless --workers
    names more.

    Example: roadtalk serve --port 9000
    """
    given = {"host": host, "port": port, "database": database, "workers": workers}
    try:
        settings = Settings(**{name: value for name, value in given.items() if value is not None})  # type: ignore[arg-type]
    except ValidationError as error:
        wrong = error.errors()[0]
        said = wrong["msg"].removeprefix("Value error, ")
        _fail(f"The setting {wrong['loc'][0]} is not valid: {said}.")
    logs.configure(settings)
    for stray in strays(os.environ):
        typer.echo(stray, err=True)
    reason = exposure_problem(settings)
    if reason is not None:
        _fail(reason)
    if settings.missing_model_setting is not None:
        _fail(f"A language model is named in part: {settings.missing_model_setting} is not set.")
    several = settings.workers > 1 or settings.ray_address is not None
    if several:
        from service.cluster.serve import missing_for_shards, serve_shards

        lacks = missing_for_shards(settings)
        if lacks is not None:
            _fail(lacks)
    listener = _listener(settings.host, settings.port)
    deadline = Deadline()
    stop_when_hung_up()
    try:
        if several:
            serve_shards(settings, listener, _say_ready)
            return
        with garbage.no_collection():
            store = open_store(settings.database)
            config = server_config(create_app(settings, store=store), settings)
        sys.setswitchinterval(SWITCH_S)
        with asyncio.Runner(loop_factory=config.get_loop_factory()) as runner:
            runner.run(serve_app(config, store, listener, deadline, lambda _: _say_ready(listener)))
    except (StoreError, LanguageDataError, MissingExtraError, PromptError, ShardsNotStartedError) as error:
        _fail(str(error))
    except KeyboardInterrupt:
        pass
    finally:
        deadline.lift()
        listener.close()


def server_config(
    app: ASGIApp, settings: Settings, *, behind_entry: bool = False, lifespan: Literal["on", "off"] = "on"
) -> uvicorn.Config:
    """How the service is run: one process, no access log, no compression of small messages.

    `behind_entry`: it is a shard, and the entry adds what a server adds to responses and trusts proxies.
    """
    return uvicorn.Config(
        app,
        loop="auto",
        **protocol_options(),
        ws_max_size=settings.max_body_bytes,
        ws_per_message_deflate=False,
        access_log=False,
        log_config=None,
        log_level="warning",
        # Off unless asked for: else every program on this machine could say that it is somebody else.
        proxy_headers=bool(settings.trusted_proxies) and not behind_entry,
        forwarded_allow_ips=settings.trusted_proxies,
        server_header=not behind_entry,
        date_header=not behind_entry,
        timeout_graceful_shutdown=STOP_S,
        lifespan=lifespan,
    )


async def warmed(app: FastAPI) -> int:
    """Ask the application for a sign of life; the status it answers.

    The first request builds every route and its readers, which takes a quarter of a second; later that would
    be in the midst of ticks, and 20 MB that stay would not be frozen.
    """
    status = 0

    async def receive() -> Message:
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message: Message) -> None:
        nonlocal status
        status = message.get("status", status)

    scope: Scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": "GET",
        "scheme": "http",
        "path": "/healthz",
        "raw_path": b"/healthz",
        "root_path": "",
        "query_string": b"",
        "headers": [],
        "client": None,
        "server": None,
    }
    await app(scope, receive, send)
    return status


async def serve_app(
    config: uvicorn.Config,
    store: Store,
    listener: socket.socket,
    deadline: Deadline,
    on_ready: Callable[[ServiceServer], None],
) -> None:
    """Run the service until it is told to stop. Raises `StoreError` for a database that cannot be opened."""
    # In a task of its own, as requests are: else all that is logged later would bear its id.
    app = cast(FastAPI, config.app)
    await asyncio.create_task(warmed(app))
    manager = app.state.context.manager
    sweep = garbage.begin(lambda: manager.live_count, lambda: manager.subscriber_count)
    sweeping = asyncio.create_task(sweep.run())
    # Before the server starts, so that a database that cannot be opened is one clear line.
    await store.open()
    server = ServiceServer(config, on_ready, deadline)
    try:
        await server.serve(sockets=[listener])
    finally:
        server.cancel_warm_up()
        sweeping.cancel()


def _say_ready(listener: socket.socket) -> None:
    host, port = listener.getsockname()[:2]
    shown = f"[{host}]" if ":" in host else host
    typer.echo(f"Roadtalk is at http://{shown}:{port}")
    sys.stdout.flush()


class ServiceServer(uvicorn.Server):
    """Says when it is ready, not before."""

    def __init__(
        self, config: uvicorn.Config, on_ready: Callable[[ServiceServer], None], deadline: Deadline
    ) -> None:
        super().__init__(config)
        self._on_ready = on_ready
        self._deadline = deadline
        self._warming: asyncio.Task[None] | None = None

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """End the streams of events and the work in processes, which would be waited for, then stop."""
        self._deadline.begin()
        context = self.config.app.state.context  # type: ignore[union-attr]
        context.event_streams.stop()
        context.manager.work.stop()
        await super().shutdown(sockets)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to listen, then say so."""
        await super().startup(sockets)
        if self.started:
            self._on_ready(self)
            languages = self.config.app.state.context.interpreter.languages  # type: ignore[union-attr]
            self._warming = asyncio.create_task(warm_up(languages))

    def cancel_warm_up(self) -> None:
        """Stop preparing for requests that will not come."""
        if self._warming is not None:
            self._warming.cancel()


def _listener(host: str, port: int) -> socket.socket:
    """A bound socket, or one clear line."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
    except OSError as error:
        listener.close()
        _fail(f"Port {port} of {host} cannot be listened on: {error.strerror}. Choose another with --port.")
    return listener


def _fail(message: str) -> NoReturn:
    """End with 1 and a message."""
    typer.echo(message, err=True)
    raise typer.Exit(1)
