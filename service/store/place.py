"""Where a backup is made before it is sent, and which database it is of."""

from __future__ import annotations

import hashlib
from pathlib import Path
from tempfile import gettempdir

from sqlalchemy.engine import make_url

from service.whole_file import new_partial

_SQLITE = "sqlite:"


def backup_place(url: str) -> Path:
    """A new, empty file: beside a SQLite database, whose disk has the room; else among temporary files."""
    if url.startswith(_SQLITE):
        return new_partial(sqlite_path(url))
    return new_partial(Path(gettempdir()) / "roadtalk-backup")


def database_mark(url: str) -> str:
    """A digest by which two programs on one machine can tell whether they mean the same database."""
    meant = f"{_SQLITE}{sqlite_path(url).resolve()}" if url.startswith(_SQLITE) else url
    return hashlib.blake2b(meant.encode(), digest_size=8).hexdigest()


def sqlite_path(url: str) -> Path:
    """The file of a SQLite URL."""
    return Path(make_url(url).database or "")
