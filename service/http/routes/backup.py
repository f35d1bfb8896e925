"""`/backup`: everything the service keeps, as one file, made while it runs.

SQLite's file belongs to the service alone, so no other program can copy it. The copy is made beside the
database (it needs as much room again), sent, and removed.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import anyio
import structlog
from anyio import to_thread
from fastapi import Response
from fastapi.responses import StreamingResponse
from starlette.types import Message, Receive, Scope, Send

from service.http.deps import Here
from service.http.errors import problem_responses
from service.http.route import api_router
from service.http.route_policy import policy
from service.problems import BackupFailed, BackupUnderWay
from service.store import StoreError
from service.store.place import backup_place, database_mark

MEDIA_TYPE = "application/octet-stream"
DATABASE_HEADER = "Roadtalk-Database"
"""Which database it is of, without its name: the command line compares it with the one that was meant."""

SEND_S = 60
"""How long a reader may take for one part of it; nobody else gets one meanwhile."""

_CHUNK = 1 << 18
_LOG = structlog.get_logger(__name__)

router = api_router("operating")

_FILE: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A SQLite file, for `roadtalk restore`.",
        "content": {MEDIA_TYPE: {"schema": {"type": "string", "format": "binary"}}},
        "headers": {
            DATABASE_HEADER: {
                "description": "A digest that tells databases apart.",
                "schema": {"type": "string"},
            }
        },
    }
}


@router.get(
    "/backup",
    response_class=Response,
    summary="Everything that is kept, as one file",
    responses=_FILE | problem_responses(BackupUnderWay, BackupFailed),
)
@policy(entity_tag=False)
async def read_backup(here: Here) -> Response:
    """All sessions, bookmarks and taught phrases as they stand now; sessions run on meanwhile.

    The file holds what every client said: keep it as private as the database. One is made at a time.
    """
    turn = object()
    try:
        here.backups.acquire_on_behalf_of_nowait(turn)
    except anyio.WouldBlock:
        raise BackupUnderWay from None
    file: Path | None = None

    def done() -> None:
        if file is not None:
            file.unlink(missing_ok=True)
        here.backups.release_on_behalf_of(turn)

    try:
        file = await to_thread.run_sync(backup_place, here.settings.database)
        await here.store.backup(file)
        size = file.stat().st_size
    except BaseException as error:
        done()
        here.metrics.count_backup("failed")
        if isinstance(error, StoreError | OSError):
            _LOG.error("no backup was made", error=str(error))
            raise BackupFailed from error
        raise
    here.metrics.count_backup("made")
    _LOG.info("a backup was made", bytes=size)
    name = f"roadtalk-{datetime.now(UTC):%Y%m%dT%H%M%SZ}.db"
    headers = {
        "Cache-Control": "no-store",
        "Content-Length": str(size),
        "Content-Disposition": f'attachment; filename="{name}"',
        DATABASE_HEADER: database_mark(here.settings.database),
    }
    return _BackupResponse(file, headers, done)


class _BackupResponse(StreamingResponse):
    """Sends a backup, then removes it, whatever becomes of the client."""

    def __init__(self, file: Path, headers: dict[str, str], done: Callable[[], None]) -> None:
        super().__init__(_chunks(file), headers=headers, media_type=MEDIA_TYPE)
        self._done = done

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_in_time(message: Message) -> None:
            with anyio.fail_after(SEND_S):
                await send(message)

        try:
            await super().__call__(scope, receive, send_in_time)
        except TimeoutError:
            _LOG.warning("whoever asked for a backup did not read it", seconds=SEND_S)
        finally:
            self._done()


async def _chunks(file: Path) -> AsyncIterator[bytes]:
    async with await anyio.open_file(file, "rb") as opened:
        while chunk := await opened.read(_CHUNK):
            yield chunk
