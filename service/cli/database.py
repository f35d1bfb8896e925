"""The database that a command is about."""

from __future__ import annotations

from typing import Annotated

import typer
from pydantic import ValidationError

from service.cli.terminal import fail
from service.settings import Settings

Database = Annotated[
    str | None,
    typer.Option(help="The database's URL; default: ROADTALK_DATABASE, as the service has it."),
]


def database_url(given: str | None) -> tuple[Settings, str]:
    """The settings, and the URL of a database that lasts; ends the command where there is none."""
    try:
        settings = Settings() if given is None else Settings(database=given)
    except ValidationError as error:
        wrong = error.errors()[0]
        fail(f"The setting {wrong['loc'][0]} is not valid: {wrong['msg'].removeprefix('Value error, ')}.")
    url = settings.database
    if url == "memory:":
        fail("The database memory: is in the memory of a service: `roadtalk backup --url` asks that service.")
    if not url.startswith(("sqlite:///", "postgresql://", "postgresql+asyncpg://")):
        fail(f"{url.partition(':')[0]!r} names no kind of database known here.")
    return settings, url
