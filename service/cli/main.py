"""The command `roadtalk`: serve, and talk to a running service from a terminal."""

from __future__ import annotations

import asyncio
import os
import socket
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, NoReturn, cast

import typer
import uvicorn
from fastapi import FastAPI
from pydantic import ValidationError
from starlette.types import Message, Scope

from service import gc_tuning as garbage
from service import log_format as logs
from service.app import create_app
from service.cli.check_planner import check_planner
from service.cli.doctor import doctor
from service.cli.replay import replay
from service.cli.say import say
from service.cli.sessions import sessions
from service.cli.watch import watch
from service.env_check import strays
from service.grammar import LanguageDataError
from service.http.middleware.header_limits import StrictHead
from service.http.realtime.websocket_server import StrictSocket
from service.llm import MissingExtraError
from service.llm.prompts import PromptError
from service.security.guard import exposed
from service.settings import Settings
from service.shutdown import Deadline, stop_when_hung_up
from service.store import Store, StoreError, open_store
from service.version import VERSION
from service.window.command import play

STOP_S = 1
"""How long a stopping service waits for requests under way."""

cli = typer.Typer(
    help="An autonomous vehicle on a road of obstacles and potholes, run in plain words.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def main() -> None:
    """The entry point of the installed command."""
    cli()


@cli.callback(invoke_without_command=True)
def _options(
    version: Annotated[bool, typer.Option("--version", help="Say which version this is.")] = False,
) -> None:
    if version:
        typer.echo(f"roadtalk {VERSION}")
        raise typer.Exit


def _default(setting: str) -> str:
    """A setting's default, for help: the option itself has none, so that the environment is heard."""
    return str(Settings.model_fields[setting].default)


@cli.command()
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
        int | None, typer.Option(help="Only 1: several would each hold some of the sessions.")
    ] = None,
) -> None:
    """Run the service and its page until it is told to stop (Ctrl-C).

    Options win over the environment (ROADTALK_HOST, ROADTALK_PORT,
    ROADTALK_DATABASE). It is one process on purpose: several would each
    hold some of the sessions.

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
    reason = exposed(settings)
    if reason is not None:
        _fail(reason)
    listener = _listener(settings.host, settings.port)
    deadline = Deadline()
    stop_when_hung_up()
    try:
        store = open_store(settings.database)
        config = server_config(create_app(settings, store=store), settings)
        with asyncio.Runner(loop_factory=config.get_loop_factory()) as runner:
            runner.run(_serve(config, store, listener, deadline))
    except (StoreError, LanguageDataError, MissingExtraError, PromptError) as error:
        _fail(str(error))
    except KeyboardInterrupt:
        pass
    finally:
        deadline.lift()
        listener.close()


@cli.command("language-eval")
def language_eval(
    file: Annotated[Path, typer.Argument(help="JSON lines of {text, actions, clarify?}.", exists=True)],
    language: Annotated[str, typer.Option(help="The language's code.")] = "en",
    failures: Annotated[bool, typer.Option(help="Also list what was not read as labelled.")] = True,
) -> None:
    """Measure how well sentences are understood. Exits with 1 when one was understood wrongly.

    Example: roadtalk language-eval labelled.jsonl
    """
    from service.grammar import Language
    from service.grammar.evaluation import evaluate_all, read_labelled, render

    try:
        grammar = Language.load(language)
        rows = read_labelled(file)
    except (LanguageDataError, ValueError) as error:
        _fail(str(error))
    with typer.progressbar(rows, label="Reading", file=sys.stderr) as reading:
        report = evaluate_all(grammar, reading)
    typer.echo(render(report, failures=failures))
    if report.total("wrong"):
        raise typer.Exit(1)


for _command in (say, watch, replay, sessions, doctor, play):
    cli.command()(_command)
cli.command("check-planner")(check_planner)


def server_config(app: FastAPI, settings: Settings) -> uvicorn.Config:
    """How the service is run: one process, no access log, no compression of small messages."""
    return uvicorn.Config(
        app,
        loop="auto",
        http=StrictHead,
        ws=StrictSocket,
        ws_max_size=settings.max_body_bytes,
        ws_per_message_deflate=False,
        access_log=False,
        log_config=None,
        log_level="warning",
        # Off unless asked for: else every program on this machine could say that it is somebody else.
        proxy_headers=bool(settings.trusted_proxies),
        forwarded_allow_ips=settings.trusted_proxies,
        timeout_graceful_shutdown=STOP_S,
        lifespan="on",
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


async def _serve(config: uvicorn.Config, store: Store, listener: socket.socket, deadline: Deadline) -> None:
    # In a task of its own, as requests are: else all that is logged later would bear its id.
    app = cast(FastAPI, config.app)
    await asyncio.create_task(warmed(app))
    manager = app.state.context.manager
    sweep = garbage.begin(lambda: manager.live, lambda: manager.watchers)
    sweeping = asyncio.create_task(sweep.run())
    # Before the server starts, so that a database that cannot be opened is one clear line.
    await store.open()
    host, port = listener.getsockname()[:2]
    shown = f"[{host}]" if ":" in host else host
    server = _Server(config, lambda: typer.echo(f"Roadtalk is at http://{shown}:{port}"), deadline)
    try:
        await server.serve(sockets=[listener])
    finally:
        sweeping.cancel()


class _Server(uvicorn.Server):
    """Says when it is ready, not before."""

    def __init__(self, config: uvicorn.Config, on_ready: Callable[[], None], deadline: Deadline) -> None:
        super().__init__(config)
        self._on_ready = on_ready
        self._deadline = deadline

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """End the streams of events, which would be waited for, then stop."""
        self._deadline.begin()
        self.config.app.state.readers.stop()  # type: ignore[union-attr]
        await super().shutdown(sockets)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to listen, then say so."""
        await super().startup(sockets)
        if self.started:
            self._on_ready()
            sys.stdout.flush()


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
