"""Records as rows of the tables, and back."""

from __future__ import annotations

from datetime import UTC
from typing import Any

from sqlalchemy import Row

from service.resources import DEFAULT_LANGUAGE
from service.store.base import (
    BookmarkRecord,
    Branch,
    EntryRecord,
    JobRecord,
    PhraseRecord,
    SessionRecord,
    SnapshotRecord,
    StoredResponse,
)


def session_to_row(record: SessionRecord) -> dict[str, Any]:
    """A session as a row."""
    branch = record.branch
    shared = branch and {
        "parent": branch.parent,
        "parent_sequence": branch.sequence,
        "parent_tick": branch.tick,
        "standing": branch.standing,
        "instead": [dict(each) for each in branch.instead],
    }
    made = record.created_at.astimezone(UTC).replace(tzinfo=None)
    return {
        "id": record.id,
        "name": record.name,
        "created_at": made,
        "used_at": made,
        "config": dict(record.config),
        "paused": record.paused,
        "tick": record.tick,
        "language": record.language,
    } | (shared or {})


def session_from_row(row: Row[Any]) -> SessionRecord:
    """A session from a row."""
    branch = None
    if row.parent is not None:
        branch = Branch(
            parent=row.parent,
            sequence=row.parent_sequence,
            tick=row.parent_tick,
            standing=row.standing,
            instead=row.instead,
        )
    return SessionRecord(
        id=row.id,
        name=row.name,
        created_at=row.created_at.replace(tzinfo=UTC),
        config=row.config,
        paused=row.paused,
        tick=row.tick,
        number=row.number,
        branch=branch,
        language=row.language or DEFAULT_LANGUAGE,
    )


def response_to_row(answer: StoredResponse) -> dict[str, Any]:
    """A response as a row."""
    return {
        "key": answer.key,
        "request": answer.request,
        "at": answer.at,
        "status": answer.status,
        "headers": dict(answer.headers),
        "body": answer.body,
    }


def entry_to_row(session_id: str, entry: EntryRecord) -> dict[str, Any]:
    """An entry as a row."""
    return {
        "session_id": session_id,
        "sequence": entry.sequence,
        "tick": entry.tick,
        "text": entry.text,
        "actions": [dict(action) for action in entry.actions],
        "digest": entry.digest,
        "paused": entry.paused,
    }


def entry_from_row(row: Row[Any]) -> EntryRecord:
    """An entry from a row."""
    return EntryRecord(
        sequence=row.sequence,
        tick=row.tick,
        text=row.text,
        actions=row.actions,
        digest=row.digest,
        paused=row.paused,
    )


def snapshot_to_row(record: SnapshotRecord) -> dict[str, Any]:
    """A snapshot as a row."""
    return {
        "session_id": record.session,
        "sequence": record.sequence,
        "tick": record.tick,
        "version": record.version,
        "checksum": record.checksum,
        "body": record.body,
    }


def snapshot_from_row(row: Row[Any]) -> SnapshotRecord:
    """A snapshot from a row."""
    return SnapshotRecord(
        session=row.session_id,
        sequence=row.sequence,
        tick=row.tick,
        version=row.version,
        checksum=row.checksum,
        body=row.body,
    )


def bookmarks_to_rows(session_id: str, entry: EntryRecord) -> list[dict[str, Any]]:
    """The bookmarks that an entry makes, as rows."""
    return [
        {"session_id": session_id, "name": name, "sequence": entry.sequence, "tick": tick}
        for name, tick in entry.names.items()
    ]


def bookmark_to_row(record: BookmarkRecord) -> dict[str, Any]:
    """A bookmark as a row, with its number."""
    return {
        "number": record.number,
        "session_id": record.session,
        "name": record.name,
        "sequence": record.sequence,
        "tick": record.tick,
    }


def phrase_to_row(record: PhraseRecord) -> dict[str, Any]:
    """A taught phrase as a row."""
    return {
        "owner": record.owner,
        "language": record.language,
        "key": record.key,
        "phrase": record.phrase,
        "meaning": [dict(action) for action in record.meaning],
    }


def job_to_row(record: JobRecord) -> dict[str, Any]:
    """A job as a row, with its number."""
    return {
        "number": record.number,
        "id": record.id,
        "kind": record.kind,
        "state": record.state,
        "created_at": record.created_at.astimezone(UTC).replace(tzinfo=None),
        "spec": dict(record.spec),
        "done": record.done,
        "total": record.total,
        "result": None if record.result is None else dict(record.result),
        "error": record.error,
    }
