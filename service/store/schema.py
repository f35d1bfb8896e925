"""Brings a database to the version of the schema that this code knows, when it is opened.

Each version is a file in `migrations/versions`, run by alembic in one transaction: a database is of
the old version or of the new one, whatever happens on the way. Databases from before versions were
written down are of version 1. There is no way back: a newer database is refused and left as it is.
"""

from __future__ import annotations

from pathlib import Path

from sqlalchemy import Connection, inspect, text

from service.store.base import StoreError
from service.store.tables import VERSION

MIGRATIONS = Path(__file__).parent / "migrations"


def migrate(connection: Connection, name: str) -> None:
    """Create the tables, or upgrade older ones. Raises `StoreError` for a newer database; does not commit."""
    version = version_of(connection)
    if version == VERSION:
        return
    if version is not None and not 1 <= version <= VERSION:
        raise StoreError(
            f"{name} cannot be opened: it is of version {version}, made by a newer roadtalk; "
            f"this one knows versions up to {VERSION}. It was left as it is."
        )
    if connection.dialect.name == "sqlite":
        # Python's driver begins none before a change of tables.
        connection.exec_driver_sql("BEGIN IMMEDIATE")
    _migrate(connection, version)


def version_of(connection: Connection) -> int | None:
    """The version of a database, None for an empty one."""
    tables = set(inspect(connection).get_table_names())
    if "alembic_version" in tables:
        found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar_one_or_none()
        return int(found) if found is not None and found.isdigit() else 0
    return 1 if "sessions" in tables else None


def _migrate(connection: Connection, version: int | None) -> None:
    # Looked for here only: most starts have nothing to bring up.
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS).replace("%", "%%"))
    config.set_main_option("path_separator", "os")
    config.attributes["connection"] = connection
    if version == 1:
        command.stamp(config, "1", purge=True)
    command.upgrade(config, str(VERSION))
