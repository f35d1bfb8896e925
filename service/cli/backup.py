"""`backup`: all that the service keeps as one file, made while the service runs."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Annotated

import typer

from service.cli.database import Database, database_url
from service.cli.terminal import ApiKey, fail, plain, service_at
from service.settings import Settings
from service.store.backup import BackupFacts, check_backup
from service.store.base import LockedError, StoreError
from service.store.engines import database_for
from service.store.place import database_mark
from service.whole_file import whole_file


def backup(
    file: Annotated[Path, typer.Argument(help="The file to write.")],
    url: Annotated[
        str | None,
        typer.Option(help="Ask the service there; default: the database, or the service that has it open."),
    ] = None,
    database: Database = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
    api_key: ApiKey = None,
) -> None:
    """Write all that the service keeps to one file, while it runs.

    A SQLite database belongs to the service that has it open, which then
    makes the copy itself. The file has its name only when it is whole and
    was checked. It holds what every client said: keep it private.

    Example: roadtalk backup roadtalk-monday.db
    """
    if file.exists() and not force:
        fail(f"{file} is there already; choose another name, or use --force.")
    if not file.parent.is_dir():
        fail(f"There is no folder {file.parent}.")
    try:
        facts = _of_service(file, url, api_key, None) if url is not None else _here(file, database, api_key)
    except StoreError as error:
        fail(plain(str(error)))
    except OSError as error:
        fail(f"{file} cannot be written: {error.strerror or error}.")
    typer.echo(f"{file}: {facts.sessions} sessions, {facts.entries} changes, version {facts.version}.")


def _here(file: Path, database: str | None, api_key: str | None) -> BackupFacts:
    """Of the database, by this process where no service has it open."""
    settings, meant = database_url(database)
    try:
        with whole_file(file, replace=True) as part:
            written = Path(part.name)
            asyncio.run(database_for(meant).copy(written))
            return check_backup(written)
    except LockedError:
        return _of_service(file, _address(settings), api_key, database_mark(meant))


def _of_service(file: Path, url: str, api_key: str | None, meant: str | None) -> BackupFacts:
    """Of a running service; `meant`: the mark of the database that it should have open."""
    typer.echo(f"Asking the service at {url} ...", err=True)
    with whole_file(file, replace=True) as part:
        written = Path(part.name)
        with service_at(url, api_key) as client:
            got = client.backup(written, replace=True)
        if meant is not None and got.database != meant:
            fail(f"The service at {url} uses another database. Say which service does, with --url.")
        return check_backup(written)


def _address(settings: Settings) -> str:
    """Where a service with these settings listens, seen from this machine."""
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(settings.host, settings.host)
    return f"http://[{host}]:{settings.port}" if ":" in host else f"http://{host}:{settings.port}"
