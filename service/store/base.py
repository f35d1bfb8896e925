"""The store protocol and its records.

A session is its configuration (with seed) and an append-only list of entries; everything else is replayed
from those. A snapshot may be stored beside it: it saves time, and losing it loses nothing.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Any, Protocol

from service.resources import DEFAULT_LANGUAGE

SECRET_BYTES = 32


class StoreError(Exception):
    """The store failed; the message is for whoever runs the service."""


class LockedError(StoreError):
    """Another process has the database open."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """How a fork's log relates to its parent's: the shared part is stored once.

    The fork shares the parent's entries up to `sequence` that were still in effect at `tick` (not undone).
    `standing` marks them, one bit per sequence number (bytes, lowest bit first, as hexadecimal). Entries of
    which only some actions were still in effect are copied into `instead`. The fork's own entries are
    numbered on from `sequence`.
    """

    parent: str
    sequence: int
    tick: int
    standing: str
    instead: Sequence[Mapping[str, Any]] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionRecord:
    """How a session began, and the last stored tick of its clock.

    `number` orders sessions by age and is given by the store; `config` is JSON values; `paused` is
    how the session began. `tick` is where the clock stood when last written: at the beginning or at a
    graceful stop. `branch` is what a fork has from its parent; `language` is that of its log and narration.
    """

    id: str
    name: str | None
    created_at: datetime
    config: Mapping[str, Any]
    paused: bool = False
    tick: int = 0
    number: int = 0
    branch: Branch | None = None
    language: str = DEFAULT_LANGUAGE

    def with_number(self, number: int) -> SessionRecord:
        """The same record with the store's number."""
        return replace(self, number=number)


@dataclass(frozen=True, slots=True, kw_only=True)
class EntryRecord:
    """One accepted change: its actions, its order, and its tick.

    `sequence` counts a session's accepted changes from 1; `actions` is JSON values in the contract's form;
    `text` is None for typed actions. `digest` is that of the world after the change, to check replays; None
    if unknown. `names` are the bookmarks it made, each with its tick; they are listed by `Store.bookmarks`
    and not read back here. `paused` is whether the clock stood, where the log does not say so (after a
    restart).
    """

    sequence: int
    tick: int
    text: str | None
    actions: Sequence[Mapping[str, Any]]
    digest: str | None = None
    names: Mapping[str, int] = field(default_factory=dict, compare=False)
    paused: bool | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class BookmarkRecord:
    """A bookmark of a session; `number` orders them by when they were made."""

    session: str
    session_name: str | None
    name: str
    sequence: int
    tick: int
    number: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PhraseRecord:
    """A taught phrase: as it was said, its words as they are compared, and its actions."""

    owner: str
    language: str
    key: str
    phrase: str
    meaning: Sequence[Mapping[str, Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredResponse:
    """The response to a request with an idempotency key, to answer a repeated request alike.

    `request` is a digest of the request; `at` is seconds since 1970, for expiry.
    """

    key: str
    request: str
    at: int
    status: int
    headers: Mapping[str, str]
    body: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class SnapshotRecord:
    """A packed snapshot of a session after the entry `sequence`, at a tick.

    `version` is that of the format and of the program, `checksum` that of all the rest; the store knows
    nothing of the `body`.
    """

    session: str
    sequence: int
    tick: int
    version: str
    checksum: str
    body: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class JobRecord:
    """A background job: what is to be done (`spec`), how far it is, and what it came to.

    `number` orders jobs by age and is given by the store. `done` of `total` counts work; `result` and `spec`
    are JSON values.
    """

    id: str
    kind: str
    state: str
    created_at: datetime
    spec: Mapping[str, Any]
    done: int = 0
    total: int = 0
    result: Mapping[str, Any] | None = None
    error: str | None = None
    number: int = 0


class Store(Protocol):
    """Durable storage of sessions. Every method may raise `StoreError`.

    A method that returns has made its change durable; one that raises has changed nothing.
    """

    async def open(self) -> None:
        """Open the store; opening twice is the same as once."""

    async def close(self) -> None:
        """Close files and connections; closing twice is the same as once."""

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: StoredResponse | None = None
    ) -> SessionRecord:
        """Store a new session, with entries if it was replayed; returns it numbered.

        An `answer` is stored in the same transaction, here and in other methods. A fork's parent has to
        exist.
        """

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None) -> None:
        """Append an entry. An unknown session or a duplicate sequence is an error."""

    async def get(self, session_id: str) -> SessionRecord | None:
        """A session, or None."""

    async def entries(self, session_id: str) -> Sequence[EntryRecord]:
        """A session's entries by sequence, with those shared with a parent; empty for an unknown session."""

    async def newest(self, limit: int, before: int | None = None) -> Sequence[SessionRecord]:
        """Up to `limit` sessions, newest first, of those with a number below `before`."""

    async def count(self) -> int:
        """The number of stored sessions."""

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        """Store the ticks of clocks, by session id; unknown sessions are skipped. Counts as use."""

    async def touch(self, session_ids: Collection[str], at: datetime) -> None:
        """Store that sessions are in use; unknown ones are skipped."""

    async def unused(self, since: datetime, limit: int, *, named: bool) -> Sequence[str]:
        """Up to `limit` sessions not used since a time, the longest unused first.

        `named`: also those with a name or a bookmark. None where no session at all was used since then.
        """

    async def rename(self, session_id: str, name: str | None) -> bool:
        """Give a session another name, or none; returns whether it existed."""

    async def delete(self, session_id: str) -> bool:
        """Delete a session, its entries and its snapshot; returns whether it existed.

        Entries that forks share stay, hidden, as long as there is a fork.
        """

    async def save_snapshot(self, record: SnapshotRecord) -> None:
        """Replace a session's snapshot; ignored for an unknown session."""

    async def snapshot(self, session_id: str) -> SnapshotRecord | None:
        """The snapshot of a session, or None."""

    async def bookmarks(
        self, limit: int, before: int | None = None, name: str | None = None
    ) -> Sequence[BookmarkRecord]:
        """Up to `limit` bookmarks, newest first, of those with a number below `before`."""

    async def save_response(self, answer: StoredResponse) -> None:
        """Store a response by itself. A duplicate key is an error."""

    async def get_response(self, key: str) -> StoredResponse | None:
        """The response stored under a key, or None."""

    async def delete_responses(self, before: int) -> None:
        """Delete responses older than a time."""

    async def shift_responses(self, newest: int) -> None:
        """Shift the times of all responses so that the newest is at this time: none expires in a stop."""

    async def save_phrase(self, record: PhraseRecord, answer: StoredResponse | None = None) -> None:
        """Store a phrase, replacing one of the same owner, language and key."""

    async def delete_phrase(
        self, owner: str, language: str, key: str, answer: StoredResponse | None = None
    ) -> bool:
        """Delete a phrase; returns whether it existed."""

    async def phrases(self, owner: str | None = None) -> Sequence[PhraseRecord]:
        """All phrases of an owner, or of all owners, by owner, language and key."""

    async def secret(self, name: str) -> bytes:
        """A secret of this store, the same whenever it is asked for; made when it is first."""

    async def backup(self, target: Path) -> None:
        """Copy everything into a new SQLite file (`service.store.backup`), while others use the store."""

    async def room(self) -> int | None:
        """Bytes that the disk of this machine has left for the store; None where it is not on one."""

    async def create_job(self, record: JobRecord) -> JobRecord:
        """Store a new job; returns it numbered."""

    async def update_job(self, record: JobRecord) -> None:
        """Replace the state, the figures, the result and the error of a job; ignored for an unknown one."""

    async def job(self, job_id: str) -> JobRecord | None:
        """A job, or None."""

    async def jobs(
        self, limit: int, before: int | None = None, state: str | None = None
    ) -> Sequence[JobRecord]:
        """Up to `limit` jobs, newest first, of those with a number below `before` and, if named, in a state.

        Their results are left out.
        """

    async def delete_job(self, job_id: str) -> bool:
        """Delete a job and its parts; returns whether it existed."""

    async def save_job_part(self, job_id: str, key: str, body: bytes, done: int) -> None:
        """Store what a piece of work came to, once, and how much is done; ignored for an unknown job."""

    async def job_parts(self, job_id: str) -> Mapping[str, bytes]:
        """What the finished pieces of a job came to, by key."""
