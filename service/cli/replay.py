"""`replay`: does a recording still come to the state it names?"""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer
from rich.console import Console

from service.cli.terminal import ApiKey, fail, plain, service_at
from service.client import AsyncClient, Client, Refused, RoadtalkError, State

NAME = "http://replay"
"""The address of the service that lives inside the command."""

_Replayed = tuple[State, str | None]
"""Where it ends, and what is told of the rules it is of."""


def replay(
    file: Annotated[Path, typer.Argument(help="A recording, as saved from a session.")],
    url: Annotated[
        str | None,
        typer.Option(help="Replay it as a new session of this service; default: here, and forget it."),
    ] = None,
    api_key: ApiKey = None,
) -> None:
    """Replay a recording and compare digests. Exits with 1 when they differ.

    No service is needed.

    Example: roadtalk replay roadtalk-abc.json
    """
    recording = _read(file)
    typer.echo(f"recorded  {plain(recording['digest'])}  tick {recording.get('tick')}")
    try:
        with Console(stderr=True).status("Replaying ..."):
            state, note = _here(recording) if url is None else _there(recording, url, api_key)
    except Refused as refused:
        fail(plain(refused.detail))
    except RoadtalkError as error:
        fail(plain(str(error)))
    typer.echo(f"replayed  {state.digest}  tick {state.tick}")
    if note is not None:
        typer.echo(plain(note))
    if state.digest != recording["digest"]:
        fail("The digests differ.")
    typer.echo("The digests are the same." + (f" Session {state.session}" if url is not None else ""))


def _read(file: Path) -> dict[str, Any]:
    try:
        values = json.loads(file.read_bytes())
    except OSError as error:
        fail(f"{file} cannot be read: {error.strerror}.")
    except ValueError:
        fail(f"{file} is no recording: it is not JSON.")
    if not isinstance(values, dict) or not isinstance(values.get("digest"), str):
        fail(f"{file} is no recording: it names no digest.")
    return values


def _there(recording: dict[str, Any], url: str, api_key: str | None) -> _Replayed:
    with service_at(url, api_key) as client:
        return _replayed(client, recording)


def _replayed(client: Client, recording: dict[str, Any]) -> _Replayed:
    session = client.create(recording=recording, paused=True)
    return session.state(), session.info().rules_note


def _here(recording: dict[str, Any]) -> _Replayed:
    """By the service itself, in this process and in memory."""
    from service.app import create_app
    from service.settings import Settings

    size = len(json.dumps(recording).encode()) + 65_536
    # The work is that of whoever runs the command.
    tick = recording.get("tick")
    ticks = max(tick if isinstance(tick, int) else 0, Settings.model_fields["max_recording_ticks"].default)
    app = create_app(Settings(database="memory:", max_recording_bytes=size, max_recording_ticks=ticks))

    async def replayed() -> _Replayed:
        async with (
            app.router.lifespan_context(app),
            AsyncClient(NAME, transport=httpx.ASGITransport(app), timeout_s=600) as client,
        ):
            session = await client.create(recording=recording, paused=True)
            return await session.state(), (await session.info()).rules_note

    return asyncio.run(replayed())
