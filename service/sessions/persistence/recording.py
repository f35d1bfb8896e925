"""A session as one small file: configuration with seed, and the changes with their ticks.

Whoever replays it comes to the same digest. Recordings are read strictly: what is not understood
is refused, never skipped. Entries of older recordings name no digests, and those of forks not always. Those
that name no version of the rules are of the first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from service.resources import DEFAULT_LANGUAGE
from service.sessions.fork import renumber
from service.sessions.session import Session
from service.store import EntryRecord

FORMAT = "roadtalk-recording"
VERSION = 1


def recording_json(session: Session, entries: Sequence[EntryRecord]) -> dict[str, Any]:
    """The recording of a session up to its present tick."""
    kept = [entry for entry in entries if entry.sequence <= session.sequence]
    if session.record.branch is not None:
        kept = renumber(kept)
    return {
        "format": FORMAT,
        "version": VERSION,
        "rules": session.timeline.config.rules,
        "name": session.record.name,
        "config": asdict(session.timeline.config),
        "entries": [_entry(entry) for entry in kept],
        "tick": session.timeline.tick,
        "digest": session.run.world.digest(),
    } | recorded_language(session.language)


def recorded_language(language: str) -> dict[str, str]:
    """The part of a recording that names its language; the default is not named, as ever."""
    return {} if language == DEFAULT_LANGUAGE else {"language": language}


def _entry(entry: EntryRecord) -> dict[str, Any]:
    """As it was said, and the digest it led to where that is known: a replay goes wrong at an entry."""
    said = asdict(entry)
    del said["names"], said["paused"]
    if said["digest"] is None:
        del said["digest"]
    return said
