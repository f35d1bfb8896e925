"""Recordings: a session as one small file of its configuration (with seed) and its changes with their ticks.

A replay leads to the same digest. Recordings are read strictly: unknown keys are refused, never skipped.
Entries of older recordings name no digests, and those of forks not always. A recording that names no
version of the rules is of version 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import partial
from itertools import pairwise
from typing import Any

from anyio import to_thread

from service.problems import FieldProblem, Invalid, RecordingMismatch
from service.resources import DEFAULT_LANGUAGE
from service.sessions.fork import renumber
from service.sessions.persistence.replay import ReplayError, replay
from service.sessions.persistence.seal import Seal
from service.sessions.scheduler.offload import REPLAY_S, with_time_limit
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.store import EntryRecord

FORMAT = "roadtalk-recording"
VERSION = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """What a recording holds beside its configuration."""

    entries: Sequence[EntryRecord]
    """numbered from 1: a new session counts its own changes; in the file they keep their session's numbers"""
    tick: int
    digest: str
    own: bool = False
    """whether this service made it, so that it may be longer than others'"""

    def __post_init__(self) -> None:
        numbers = [entry.sequence for entry in self.entries]
        # A fork may have parts of one change at several ticks. Whatever is not in order the replay refuses.
        if all(one <= two for one, two in pairwise(numbers)):
            object.__setattr__(self, "entries", renumber(self.entries))


async def replay_recording(session: Session, recording: Recording, services: SessionServices) -> None:
    """Replay a recording on a new session. Raises `Invalid`, or `RecordingMismatch` for another digest."""
    try:
        most = None if recording.own else services.settings.max_recording_ticks
        work = partial(replay, session, session.narrator, recording.entries, recording.tick, most=most)
        await to_thread.run_sync(with_time_limit(REPLAY_S, work))
    except ReplayError as error:
        at = error.position
        field = f"recording.entries.{at}" if at < len(recording.entries) else "recording.tick"
        if error.differs:
            raise RecordingMismatch(
                f"{error} It was changed, or made by other rules.",
                errors=[FieldProblem(f"{field}.digest", str(error))],
            ) from error
        raise Invalid(
            "The recording cannot be replayed.", errors=[FieldProblem(field, str(error))]
        ) from error
    if session.timeline.tick != recording.tick:
        ends = session.timeline.tick
        raise RecordingMismatch(f"Replayed, it ends at tick {ends}, not at {recording.tick}.")
    digest = session.run.world.digest()
    if digest != recording.digest:
        raise RecordingMismatch(
            f"Replayed, it ends in {digest}, not in {recording.digest}: "
            "it was changed, or made by other rules."
        )


def recording_json(
    session: Session, entries: Sequence[EntryRecord], seal: Seal | None = None
) -> dict[str, Any]:
    """The recording of a session up to its present tick; sealed where it is longer than others may be."""
    kept = [entry for entry in entries if entry.sequence <= session.sequence]
    made: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "rules": session.timeline.config.rules,
        "name": session.record.name,
        "config": asdict(session.timeline.config),
        "entries": [_entry(entry) for entry in kept],
        "tick": session.timeline.tick,
        "digest": session.run.world.digest(),
    } | recorded_language(session.language)
    if seal is not None and made["tick"] > session.services.settings.max_recording_ticks:
        made["seal"] = seal.of(made["config"], kept, made["tick"], made["digest"], session.language)
    return made


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
