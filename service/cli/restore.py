"""`restore`: a backup in the place of the database."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Annotated

import typer

from service.cli.database import Database, database_url
from service.cli.terminal import fail, plain
from service.store.base import StoreError
from service.store.restore import NotEmptyError, restore_database


def restore(
    file: Annotated[Path, typer.Argument(help="A backup, as written by `roadtalk backup`.")],
    database: Database = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace a database; a SQLite file is kept under another name.")
    ] = False,
) -> None:
    """Put a backup in the place of the database.

    The service must not be running. The backup is checked first: its
    pages, its references, and that its version is known here.

    Example: roadtalk restore roadtalk-monday.db
    """
    if not file.is_file():
        fail(f"There is no file {file}.")
    _, meant = database_url(database)
    try:
        facts, kept = asyncio.run(restore_database(file, meant, replace=force))
    except NotEmptyError as error:
        fail(plain(f"{error} Use --force to replace it."))
    except StoreError as error:
        fail(plain(str(error)))
    except OSError as error:
        fail(f"{file} cannot be read: {error.strerror or error}.")
    typer.echo(f"Restored {facts.sessions} sessions and {facts.entries} changes, version {facts.version}.")
    if kept is not None:
        typer.echo(f"What was there before is kept: {kept}")
