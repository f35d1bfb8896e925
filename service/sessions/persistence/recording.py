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

from service.problems import FieldProblem, Invalid, RecordingMismatch
from service.resources import DEFAULT_LANGUAGE
from service.sessions.fork import renumber
from service.sessions.persistence.replay import ReplayError, replay
from service.sessions.persistence.replay_elsewhere import replay_log
from service.sessions.persistence.seal import Seal
from service.sessions.scheduler.offload import REPLAY_S, run_in_thread, uses_installed_planner
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.work_estimate import log_units
from service.store import EntryRecord
from service.work.units import THREAD

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


async def replay_recording(session: Session, recording: Recording, services: SessionServices) -> Session:
    """The session that a recording leads to; `session`: a new one of its configuration, which is used up.

    Raises `Invalid`, `RecordingMismatch` for another digest, and what the executor of work raises.
    """
    most = None if recording.own else services.settings.max_recording_ticks
    record, entries = session.record, recording.entries
    units = await services.work.in_thread(log_units, session.timeline.config, entries, recording.tick)
    if not recording.own:
        services.work.check(units)
    try:
        work = partial(replay, session, session.narrator, entries, recording.tick, most=most)
        if uses_installed_planner(session.timeline.config, entries):
            await run_in_thread(True, REPLAY_S, work)
        elif units <= THREAD:
            await services.work.in_thread(work)
        else:
            done = await services.work.in_process(
                units, replay_log, record, entries, recording.tick, services.narrator, services.settings, most
            )
            session = done.revive(record, services)
    except ReplayError as error:
        raise _refusal(recording, error) from error
    _check(session, recording)
    return session


def _refusal(recording: Recording, error: ReplayError) -> Invalid:
    at = error.position
    field = f"recording.entries.{at}" if at < len(recording.entries) else "recording.tick"
    if error.differs:
        return RecordingMismatch(
            f"{error} It was changed, or made by other rules.",
            errors=[FieldProblem(f"{field}.digest", str(error))],
        )
    return Invalid("The recording cannot be replayed.", errors=[FieldProblem(field, str(error))])


def _check(session: Session, recording: Recording) -> None:
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
