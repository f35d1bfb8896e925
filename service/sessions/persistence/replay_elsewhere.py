"""Replays in a worker process: a log is performed there, and what it led to comes back as a snapshot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.persistence.replay import replay, replay_one
from service.sessions.persistence.session_snapshot import SessionSnapshot
from service.sessions.scheduler.wheel_clock import WheelClock
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.settings import Settings
from service.store import EntryRecord, MemoryStore, SessionRecord
from sim.session.saved_config import saved_config
from sim.session.timeline import Timeline


@dataclass(frozen=True, slots=True)
class Replayed:
    """What a replay led to."""

    snapshot: SessionSnapshot
    work: int
    """work of a restore, as `LogPosition` counts it"""

    def revive(self, record: SessionRecord, services: SessionServices) -> Session:
        """A new session as the replay left it: paused, and nobody else has it."""
        session = Session(record, self.snapshot.timeline, services)
        self.snapshot.apply_to(session)
        session.log_position.work = self.work
        session.log_position.counted_work = self.snapshot.timeline.worked
        session.paused = True
        return session


def replay_log(
    record: SessionRecord,
    entries: Sequence[EntryRecord],
    tick: int,
    narrator: NarratorProtocol,
    settings: Settings,
    most: int | None = None,
) -> Replayed:
    """Replay entries on a new session and run on to a tick; for a worker process.

    Raises `ReplayError`, and what `saved_config` raises.
    """
    session = _new_session(record, Timeline(saved_config(record.config)), narrator, settings)
    replay(session, session.narrator, entries, tick, most=most)
    return Replayed(SessionSnapshot.take(session), session.log_position.work)


def replay_entry(
    record: SessionRecord,
    snapshot: SessionSnapshot,
    entry: EntryRecord,
    narrator: NarratorProtocol,
    settings: Settings,
) -> Replayed:
    """Replay one entry on the session of a snapshot; for a worker process. Raises `ProblemError`."""
    session = _new_session(record, snapshot.timeline, narrator, settings)
    snapshot.apply_to(session)
    replay_one(session, session.narrator, entry)
    return Replayed(SessionSnapshot.take(session), session.log_position.work)


def _new_session(
    record: SessionRecord, timeline: Timeline, narrator: NarratorProtocol, settings: Settings
) -> Session:
    return Session(record, timeline, SessionServices(MemoryStore(), WheelClock(), narrator, settings))
