"""The log position of a session: where it stands relative to its stored log.

Tracks where a session differs from a replay of its log: a restart leaves a session paused that nobody paused,
and so does a defect. The next entry is stored with that, so that a replay performs it on the same state.
`digest` is a running digest of all entries, to tell whether a snapshot was made from this log.
"""

from __future__ import annotations

import json
from hashlib import blake2b
from typing import Any

import orjson

from service.store import EntryRecord, SessionRecord

ENTRY_WORK = 2
"""Work of replaying an entry beside its ticks, in ticks."""


class LogPosition:
    """The position, and the work that a restore would take from the latest snapshot."""

    __slots__ = ("counted_work", "digest", "paused", "tick", "work")

    def __init__(self, record: SessionRecord) -> None:
        self.paused = record.paused
        """whether the clock stands, as a replay would have it"""
        self.tick = 0
        """the tick of the latest change"""
        self.work = 0
        """approximate work of a restore from the latest snapshot, in ticks"""
        self.counted_work = 0
        """how much of the timeline's work is counted in `work`"""
        branch = record.branch
        shared = branch and [branch.parent, branch.sequence, branch.tick, branch.standing, [*branch.instead]]
        begun = [record.id, dict(record.config), record.paused, shared]
        self.digest = _digest(b"", begun)

    def append(self, entry: EntryRecord) -> None:
        """Take in one more stored entry."""
        said = [entry.sequence, entry.tick, entry.text, [*entry.actions], entry.digest, entry.paused]
        self.digest = _digest(self.digest, said)

    def add_work(self, worked: int, entries: int) -> int:
        """Add the work of a timeline and of some entries; returns the work since the latest snapshot."""
        self.work += max(0, worked - self.counted_work) + ENTRY_WORK * entries
        self.counted_work = worked
        return self.work

    def commit(self, paused: bool, tick: int) -> None:
        """Record the pause and the tick after a change."""
        self.paused, self.tick = paused, tick


def _digest(before: bytes, values: list[Any]) -> bytes:
    try:
        line = orjson.dumps(values, option=orjson.OPT_SORT_KEYS)
    except TypeError:  # half a character, in a store that takes it
        line = json.dumps(values, sort_keys=True).encode()
    return blake2b(before + line, digest_size=16).digest()
