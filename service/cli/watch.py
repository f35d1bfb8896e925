"""`watch`: a session's life, line by line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import typer

from service.cli.terminal import (
    URL,
    ApiKey,
    AsJson,
    SessionId,
    Url,
    echo_json,
    plain,
    service_at,
    session_of,
)
from service.client.messages import Changed, Gone, Hello, Message, Standing, Tick


def watch(
    session: SessionId = None,
    ticks: Annotated[int | None, typer.Option(min=1, help="End after so many ticks.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only what happens, not every move.")] = False,
    as_json: AsJson = False,
    url: Url = URL,
    api_key: ApiKey = None,
) -> None:
    """Print what a session does as it does it, until Ctrl-C or until it is deleted.

    A lost connection is opened again.

    Example: roadtalk watch --ticks 20
    """
    seen = 0
    try:
        with service_at(url, api_key) as client:
            for message in session_of(client, session).watch():
                if as_json:
                    echo_json(message.raw)
                else:
                    for line in lines(message, quiet=quiet):
                        typer.echo(plain(line))
                seen += isinstance(message, Tick)
                if seen == ticks:
                    return
    except KeyboardInterrupt:
        typer.echo()


def lines(message: Message, *, quiet: bool = False) -> Iterator[str]:
    """A message in words."""
    match message:
        case Hello():
            standing = "paused" if message.state.paused else "running"
            again = "Back with" if message.resumed else "Watching"
            name = message.session.name or message.session.id
            yield f"{again} {name}: tick {message.state.tick}, {standing}"
            if message.state.paused:
                how = f"roadtalk say resume --session {message.session.id}"
                yield f"Nothing happens while it is paused. To go on: {how}"
        case Tick():
            if message.decision is not None and not quiet:
                yield f"{message.tick:>6}  {message.decision.move:<14} {message.narration or ''}".rstrip()
            yield from (f"{message.tick:>6}  * {event.text}" for event in message.events)
        case Changed():
            if message.text is None and message.events and message.reply == message.events[-1].text:
                yield from (f"{message.state.tick:>6}  * {event.text}" for event in message.events)
            else:
                yield f"{message.state.tick:>6}  > {message.text or 'typed'}: {message.reply}"
        case Standing():
            if message.missed is not None:
                first, last = message.missed
                yield f"{message.state.tick:>6}  ! ticks {first} to {last} were missed"
        case Gone():
            yield "The session was deleted."
