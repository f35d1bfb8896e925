"""What all commands share: where the service is, how one fails, and what may reach a terminal."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from service.client import Client, Session

PIPED_COLUMNS = 100
"""Width of what is laid out in lines where no screen tells its own."""

Url = Annotated[str, typer.Option(help="Where the service is.")]
ApiKey = Annotated[
    str | None,
    typer.Option(
        envvar="ROADTALK_API_KEY", show_envvar=True, help="The service's key; better in the environment."
    ),
]
SessionId = Annotated[str | None, typer.Option(help="A session's id; default: the newest, or a new one.")]

AsJson = Annotated[
    bool, typer.Option("--json", help="Print what the service answered: a JSON object on each line.")
]

URL = "http://127.0.0.1:8000"
"""The client's own default, which is not imported for it: most of a command's start is that import."""


def fail(message: str) -> NoReturn:
    """End with 1 and a message."""
    typer.echo(message, err=True)
    raise typer.Exit(1)


@contextmanager
def service_at(url: str, api_key: str | None) -> Iterator[Client]:
    """A client; what it raises ends the command with one clear line."""
    from service.client import Client, RoadtalkError

    try:
        with Client(url, api_key=api_key) as client:
            yield client
    except (RoadtalkError, ValueError) as error:
        fail(plain(str(error)))


def session_of(client: Client, session_id: str | None) -> Session:
    """The session that was named, else the newest, else a new one."""
    if session_id is not None:
        return client.session(session_id)
    page = client.list(limit=1)
    return client.session(page.items[0].id) if page.items else client.create()


def echo_json(value: Mapping[str, Any]) -> None:
    """A line for programs; all but ASCII is escaped, so nothing in it drives a terminal."""
    typer.echo(json.dumps(value))


def console() -> Console:
    """Standard output; nothing said by others is read as mark-up."""
    from rich.console import Console

    width = None if sys.stdout.isatty() else PIPED_COLUMNS
    return Console(width=width, markup=False, highlight=False, emoji=False)


def plain(text: str) -> str:
    """A text without what a terminal would obey: others may have said it."""
    return "".join(letter if letter.isprintable() or letter == "\n" else "�" for letter in text)
