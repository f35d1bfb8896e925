"""What a session has of its own log: what a replay of it would come to, where that is not what there is.

A restart leaves a session paused that nobody paused, and a defect does so as well: the log does not tell. The
next change is kept with that, so that a replay tries it on the same ground. The `trail` is a digest of all
that was kept so far, to know whether what claims to be made of this log is.
"""

from __future__ import annotations

import json
from hashlib import blake2b
from typing import Any

import orjson

from service.store import EntryRecord, SessionRecord

ENTRY_WORK = 2
"""What a change takes beside what it does, in ticks."""


class LogPosition:
    """A session as its log has it."""

    __slots__ = ("counted_work", "digest", "paused", "tick", "work")

    def __init__(self, record: SessionRecord) -> None:
        self.paused = record.paused
        """whether time stands still, as the log has it"""
        self.tick = 0
        """where time stood when the latest change was done"""
        self.work = 0
        """about how much work it would be to come here from the latest snapshot"""
        self.counted_work = 0
        """of its timeline's work, how much is in that"""
        branch = record.branch
        shared = branch and [branch.parent, branch.sequence, branch.tick, branch.standing, [*branch.instead]]
        begun = [record.id, dict(record.config), record.paused, shared]
        self.digest = _digest(b"", begun)

    def append(self, entry: EntryRecord) -> None:
        """One more change is in the log."""
        said = [entry.sequence, entry.tick, entry.text, [*entry.actions], entry.digest, entry.paused]
        self.digest = _digest(self.digest, said)

    def add_work(self, worked: int, entries: int) -> int:
        """A timeline has come to have so much work in it, by so many changes; what is owed now."""
        self.work += max(0, worked - self.counted_work) + ENTRY_WORK * entries
        self.counted_work = worked
        return self.work

    def commit(self, paused: bool, tick: int) -> None:
        """A change was done."""
        self.paused, self.tick = paused, tick


def _digest(before: bytes, values: list[Any]) -> bytes:
    try:
        line = orjson.dumps(values, option=orjson.OPT_SORT_KEYS)
    except TypeError:  # half a character, in a store that takes it
        line = json.dumps(values, sort_keys=True).encode()
    return blake2b(before + line, digest_size=16).digest()
