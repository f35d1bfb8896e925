"""A store in memory: for tests, demonstrations and `database=memory:`.

It satisfies the same protocol and the same tests as the SQL store.
"""

from __future__ import annotations

import secrets
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from anyio import to_thread

from service.store.base import (
    SECRET_BYTES,
    BookmarkRecord,
    Branch,
    EntryRecord,
    JobRecord,
    PhraseRecord,
    SessionRecord,
    SnapshotRecord,
    StoredResponse,
    StoreError,
)
from service.store.fork_log import join_logs


class MemoryStore:
    """A `Store` made of dictionaries."""

    def __init__(self) -> None:
        self._sessions: dict[str, SessionRecord] = {}
        self._entries: dict[str, dict[int, EntryRecord]] = {}
        self._phrases: dict[tuple[str, str, str], PhraseRecord] = {}
        self._answers: dict[str, StoredResponse] = {}
        self._last_number = 0
        self._moments: dict[tuple[str, str], BookmarkRecord] = {}
        self._last_moment = 0
        self._unseen: set[str] = set()
        self._snapshots: dict[str, SnapshotRecord] = {}
        self._used_at: dict[str, datetime] = {}
        self._secrets: dict[str, bytes] = {}
        self._jobs: dict[str, JobRecord] = {}
        self._parts: dict[str, dict[str, bytes]] = {}

    async def open(self) -> None:
        """Do nothing."""

    async def close(self) -> None:
        """Keep the data, so that a test can close and open the store again like a file."""

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: StoredResponse | None = None
    ) -> SessionRecord:
        """See `Store.create`."""
        if record.id in self._sessions:
            raise StoreError(f"session {record.id} is there already")
        if record.branch is not None and record.branch.parent not in self._sessions:
            raise StoreError(f"no session {record.branch.parent}")
        await self._add_response(answer)
        self._last_number += 1
        numbered = record.with_number(self._last_number)
        self._sessions[record.id] = numbered
        self._used_at[record.id] = record.created_at
        self._entries[record.id] = {entry.sequence: entry for entry in entries}
        for entry in entries:
            self._name(record.id, entry)
        return numbered

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None) -> None:
        """See `Store.append`."""
        entries = self._entries.get(session_id)
        if entries is None or session_id in self._unseen:
            raise StoreError(f"no session {session_id}")
        if entry.sequence in entries:
            raise StoreError(f"session {session_id} has an entry {entry.sequence} already")
        await self._add_response(answer)
        entries[entry.sequence] = entry
        self._name(session_id, entry)

    async def get(self, session_id: str) -> SessionRecord | None:
        """See `Store.get`."""
        return None if session_id in self._unseen else self._sessions.get(session_id)

    async def entries(self, session_id: str) -> Sequence[EntryRecord]:
        """See `Store.entries`."""
        return [] if session_id in self._unseen else self._log(session_id)

    def _log(self, session_id: str) -> list[EntryRecord]:
        line: list[tuple[Branch | None, list[EntryRecord]]] = []
        record = self._sessions.get(session_id)
        while record is not None:
            own = [entry for _, entry in sorted(self._entries[record.id].items())]
            line.append((record.branch, own))
            record = self._sessions[record.branch.parent] if record.branch else None
        return join_logs(reversed(line))

    async def newest(self, limit: int, before: int | None = None) -> Sequence[SessionRecord]:
        """See `Store.newest`."""
        records = sorted(self._sessions.values(), key=lambda record: -record.number)
        seen = [record for record in records if record.id not in self._unseen]
        return [record for record in seen if before is None or record.number < before][:limit]

    async def count(self) -> int:
        """See `Store.count`."""
        return len(self._sessions.keys() - self._unseen)

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        """See `Store.save_ticks`."""
        for session_id, tick in ticks.items():
            if session_id in self._sessions:
                self._sessions[session_id] = replace(self._sessions[session_id], tick=tick)
        await self.touch(ticks.keys(), datetime.now(UTC))

    async def touch(self, session_ids: Collection[str], at: datetime) -> None:
        """See `Store.touch`."""
        self._used_at |= {each: at for each in session_ids if each in self._sessions}

    async def unused(self, since: datetime, limit: int, *, named: bool) -> Sequence[str]:
        """See `Store.unused`."""
        if all(at < since for at in self._used_at.values()):
            return []
        bookmarked = {each.session for each in self._moments.values()}
        found = [
            each.id
            for each in self._sessions.values()
            if each.id not in self._unseen
            and self._used_at[each.id] < since
            and (named or (each.name is None and each.id not in bookmarked))
        ]
        return sorted(found, key=self._used_at.__getitem__)[:limit]

    async def rename(self, session_id: str, name: str | None) -> bool:
        """See `Store.rename`."""
        if session_id not in self._sessions or session_id in self._unseen:
            return False
        self._sessions[session_id] = replace(self._sessions[session_id], name=name)
        return True

    async def delete(self, session_id: str) -> bool:
        """See `Store.delete`."""
        if session_id not in self._sessions or session_id in self._unseen:
            return False
        self._moments = {key: each for key, each in self._moments.items() if each.session != session_id}
        self._snapshots.pop(session_id, None)
        self._unseen.add(session_id)
        self._clear(session_id)
        return True

    def _clear(self, session_id: str) -> None:
        """Remove a hidden session, and its hidden parents, where no fork needs them."""
        forked = [record.branch.parent for record in self._sessions.values() if record.branch is not None]
        while session_id in self._unseen and session_id not in forked:
            self._unseen.remove(session_id)
            self._entries.pop(session_id)
            self._used_at.pop(session_id)
            branch = self._sessions.pop(session_id).branch
            if branch is None:
                return
            session_id = branch.parent
            forked.remove(session_id)

    async def save_snapshot(self, record: SnapshotRecord) -> None:
        """See `Store.save_snapshot`."""
        if record.session in self._sessions and record.session not in self._unseen:
            self._snapshots[record.session] = record

    async def snapshot(self, session_id: str) -> SnapshotRecord | None:
        """See `Store.snapshot`."""
        return self._snapshots.get(session_id)

    async def bookmarks(
        self, limit: int, before: int | None = None, name: str | None = None
    ) -> Sequence[BookmarkRecord]:
        """See `Store.bookmarks`."""
        newest = sorted(self._moments.values(), key=lambda each: -each.number)
        found = [each for each in newest if before is None or each.number < before]
        return [each for each in found if name is None or each.name == name][:limit]

    def _name(self, session_id: str, entry: EntryRecord) -> None:
        for name, tick in entry.names.items():
            self._last_moment += 1
            self._moments[session_id, name] = BookmarkRecord(
                session=session_id,
                session_name=self._sessions[session_id].name,
                name=name,
                sequence=entry.sequence,
                tick=tick,
                number=self._last_moment,
            )

    async def save_response(self, answer: StoredResponse) -> None:
        """See `Store.save_response`."""
        await self._add_response(answer)

    async def get_response(self, key: str) -> StoredResponse | None:
        """See `Store.get_response`."""
        return self._answers.get(key)

    async def delete_responses(self, before: int) -> None:
        """See `Store.delete_responses`."""
        self._answers = {key: each for key, each in self._answers.items() if each.at >= before}

    async def shift_responses(self, newest: int) -> None:
        """See `Store.shift_responses`."""
        by = newest - max((each.at for each in self._answers.values()), default=newest)
        self._answers = {key: replace(each, at=each.at + by) for key, each in self._answers.items()}

    async def _add_response(self, answer: StoredResponse | None) -> None:
        if answer is None:
            return
        if answer.key in self._answers:
            raise StoreError(f"there is an answer under the key {answer.key} already")
        self._answers[answer.key] = answer

    async def save_phrase(self, record: PhraseRecord, answer: StoredResponse | None = None) -> None:
        """See `Store.save_phrase`."""
        await self._add_response(answer)
        self._phrases[record.owner, record.language, record.key] = record

    async def delete_phrase(
        self, owner: str, language: str, key: str, answer: StoredResponse | None = None
    ) -> bool:
        """See `Store.delete_phrase`."""
        await self._add_response(answer)
        return self._phrases.pop((owner, language, key), None) is not None

    async def phrases(self, owner: str | None = None) -> Sequence[PhraseRecord]:
        """See `Store.phrases`."""
        return [each for _, each in sorted(self._phrases.items()) if owner in (None, each.owner)]

    async def secret(self, name: str) -> bytes:
        """See `Store.secret`."""
        return self._secrets.setdefault(name, secrets.token_bytes(SECRET_BYTES))

    async def room(self) -> int | None:
        """See `Store.room`."""
        return None

    async def backup(self, target: Path) -> None:
        """See `Store.backup`."""
        # Imported here: a service in memory has no use for SQLAlchemy otherwise.
        from service.store import rows, tables
        from service.store.backup import write_file

        sessions = [
            rows.session_to_row(each)
            | {
                "number": each.number,
                "unseen": each.id in self._unseen,
                "used_at": self._used_at[each.id].astimezone(UTC).replace(tzinfo=None),
            }
            for each in self._sessions.values()
        ]
        entries = [
            rows.entry_to_row(of, entry) for of, own in self._entries.items() for entry in own.values()
        ]
        contents = [
            (tables.SESSIONS, sessions),
            (tables.ENTRIES, entries),
            (tables.MOMENTS, [rows.bookmark_to_row(each) for each in self._moments.values()]),
            (tables.SNAPSHOTS, [rows.snapshot_to_row(each) for each in self._snapshots.values()]),
            (tables.PHRASES, [rows.phrase_to_row(each) for each in self._phrases.values()]),
            (tables.IDEMPOTENCY, [rows.response_to_row(each) for each in self._answers.values()]),
            (tables.SECRETS, [{"name": name, "value": value} for name, value in self._secrets.items()]),
            (tables.JOBS, [rows.job_to_row(each) for each in self._jobs.values()]),
            (
                tables.JOB_PARTS,
                [
                    {"job_id": of, "key": key, "body": body}
                    for of, parts in self._parts.items()
                    for key, body in parts.items()
                ],
            ),
        ]
        await to_thread.run_sync(write_file, target, contents)

    async def create_job(self, record: JobRecord) -> JobRecord:
        """See `Store.create_job`."""
        if record.id in self._jobs:
            raise StoreError(f"job {record.id} is there already")
        last = max((job.number for job in self._jobs.values()), default=0)
        self._jobs[record.id] = numbered = replace(record, number=last + 1)
        self._parts[record.id] = {}
        return numbered

    async def update_job(self, record: JobRecord) -> None:
        """See `Store.update_job`."""
        if record.id in self._jobs:
            self._jobs[record.id] = replace(record, number=self._jobs[record.id].number)

    async def job(self, job_id: str) -> JobRecord | None:
        """See `Store.job`."""
        return self._jobs.get(job_id)

    async def jobs(
        self, limit: int, before: int | None = None, state: str | None = None
    ) -> Sequence[JobRecord]:
        """See `Store.jobs`."""
        found = [
            replace(job, result=None)
            for job in self._jobs.values()
            if (before is None or job.number < before) and state in (None, job.state)
        ]
        return sorted(found, key=lambda job: -job.number)[:limit]

    async def delete_job(self, job_id: str) -> bool:
        """See `Store.delete_job`."""
        self._parts.pop(job_id, None)
        return self._jobs.pop(job_id, None) is not None

    async def save_job_part(self, job_id: str, key: str, body: bytes, done: int) -> None:
        """See `Store.save_job_part`."""
        if job_id in self._jobs:
            self._jobs[job_id] = replace(self._jobs[job_id], done=done)
            self._parts[job_id][key] = body

    async def job_parts(self, job_id: str) -> Mapping[str, bytes]:
        """See `Store.job_parts`."""
        return dict(self._parts.get(job_id, {}))
