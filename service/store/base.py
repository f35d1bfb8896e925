"""What a store must do, in terms of what a session is: a start and the changes said to it.

A session is its configuration (seed included) and an append-only list of entries; everything else
is replayed from those. A snapshot of what that comes to may be kept beside it: it saves time, and
nothing is lost with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from typing import Any, Protocol

from service.resources import DEFAULT_LANGUAGE


class StoreError(Exception):
    """The store could not do it; the message is for whoever runs the service."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """Where a fork's log leaves its parent's: what it has in common is kept once.

    Common are those of the parent's changes up to `sequence` that stood at `tick`, which `standing` names as
    a bit for each number (bytes, lowest bit first, as hexadecimal); `instead` are those that stand in part
    only, written out. The fork's own changes are numbered on from `sequence`.
    """

    parent: str
    sequence: int
    tick: int
    standing: str
    instead: Sequence[Mapping[str, Any]] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionRecord:
    """How a session began, and how far its clock is known to have run.

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
        """The same record under the store's number."""
        return replace(self, number=number)


@dataclass(frozen=True, slots=True, kw_only=True)
class EntryRecord:
    """One accepted change: what was done, in which order, and at which tick it took effect.

    `sequence` counts a session's accepted changes from 1; `actions` is JSON values in the
    contract's form; `text` is what was said, None for typed actions. `digest` is that of the world
    after it, to know whether it was done again the same; None where it was never known. `names` are those
    it gave to moments, each with its tick; they are listed by themselves and not read back with it.
    `paused` is whether time stood still when it was said, where the log does not tell: after a restart.
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
    """A moment of a session that has a name; `number` orders them by when they were named."""

    session: str
    session_name: str | None
    name: str
    sequence: int
    tick: int
    number: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PhraseRecord:
    """A taught phrase: as it was said, its words as they are compared, and the actions it means."""

    owner: str
    language: str
    key: str
    phrase: str
    meaning: Sequence[Mapping[str, Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredResponse:
    """What a request under an idempotency key was answered, so that sent again it is answered the same.

    `request` is a digest of what was asked; `at` is seconds since 1970, for forgetting it in time.
    """

    key: str
    request: str
    at: int
    status: int
    headers: Mapping[str, str]
    body: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class SnapshotRecord:
    """What a session's log comes to after the change `sequence`, at a tick.

    `version` is that of its form and of the program that made it, `checksum` that of all the rest; what they
    are, and what `body` holds, is the business of who made it.
    """

    session: str
    sequence: int
    tick: int
    version: str
    checksum: str
    body: bytes


class Store(Protocol):
    """A place where sessions outlive the process. Every method may raise `StoreError`.

    A method that returns has made its change durable; one that raises has changed nothing.
    """

    async def open(self) -> None:
        """Make ready; opening twice is the same as once."""

    async def close(self) -> None:
        """Let go of files and connections; closing twice is the same as once."""

    async def create(
        self, record: SessionRecord, entries: Sequence[EntryRecord] = (), answer: StoredResponse | None = None
    ) -> SessionRecord:
        """Keep a new session, with entries if it is a replayed one; answers it numbered.

        An `answer` is kept with it or not at all, here and wherever one is taken. A fork's parent has to be
        there.
        """

    async def append(self, session_id: str, entry: EntryRecord, answer: StoredResponse | None = None) -> None:
        """Keep one more change of a session. An unknown session or a sequence twice is an error."""

    async def get(self, session_id: str) -> SessionRecord | None:
        """One session, or None."""

    async def entries(self, session_id: str) -> Sequence[EntryRecord]:
        """A session's changes by sequence, with those it shares with a parent; empty for an unknown one."""

    async def newest(self, limit: int, before: int | None = None) -> Sequence[SessionRecord]:
        """Up to `limit` sessions, newest first, of those with a number below `before`."""

    async def count(self) -> int:
        """How many sessions are kept."""

    async def save_ticks(self, ticks: Mapping[str, int]) -> None:
        """Remember how far clocks have run, by session id; unknown sessions are passed over."""

    async def delete(self, session_id: str) -> bool:
        """Forget a session, its changes and its snapshot; whether there was one.

        What forks share with it is kept, unseen, as long as there is one.
        """

    async def save_snapshot(self, record: SnapshotRecord) -> None:
        """Keep a session's snapshot in place of the one before; none of an unknown session is kept."""

    async def snapshot(self, session_id: str) -> SnapshotRecord | None:
        """The snapshot of a session, or None."""

    async def bookmarks(
        self, limit: int, before: int | None = None, name: str | None = None
    ) -> Sequence[BookmarkRecord]:
        """Up to `limit` named moments, newest first, of those with a number below `before`."""

    async def save_response(self, answer: StoredResponse) -> None:
        """Keep an answer by itself. A key twice is an error."""

    async def get_response(self, key: str) -> StoredResponse | None:
        """What was answered under a key, or None."""

    async def delete_responses(self, before: int) -> None:
        """Forget the answers of before a moment."""

    async def shift_responses(self, newest: int) -> None:
        """Move all answers in time together, so that the newest is of this moment."""

    async def save_phrase(self, record: PhraseRecord, answer: StoredResponse | None = None) -> None:
        """Keep a phrase, in place of the one of that owner, language and key if there is one."""

    async def delete_phrase(
        self, owner: str, language: str, key: str, answer: StoredResponse | None = None
    ) -> bool:
        """Forget a phrase; whether there was one."""

    async def phrases(self, owner: str) -> Sequence[PhraseRecord]:
        """All phrases of an owner, by language and key."""
