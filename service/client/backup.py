"""A backup of all that a service keeps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import httpx

from service.client.errors import UnexpectedAnswer

DATABASE_HEADER = "Roadtalk-Database"
MEDIA_TYPE = "application/octet-stream"


@dataclass(frozen=True, slots=True)
class Backup:
    """A backup that was written to `path`; `database` is a digest that tells databases apart."""

    path: Path
    database: str


def read_backup(path: Path, response: httpx.Response) -> Backup:
    """What the headers of the answer say. Raises `UnexpectedAnswer`."""
    if response.headers.get("content-type") != MEDIA_TYPE:
        raise UnexpectedAnswer(f"What answers at {response.url.host} sends no backup.")
    return Backup(path, response.headers.get(DATABASE_HEADER, ""))
