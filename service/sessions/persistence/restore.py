"""Restores a stored session: from its snapshot if that fits, else from its whole log."""

from __future__ import annotations

from collections.abc import Sequence

import structlog

from service.sessions.persistence.replay import ReplayError, replay
from service.sessions.persistence.snapshot_records import UnfitError, unpack
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.store import EntryRecord, SessionRecord, SnapshotRecord
from sim.session.saved_config import saved_config
from sim.session.timeline import Timeline

_LOG = structlog.get_logger(__name__)

LONG_ENTRIES = 1_000
"""A replay of so many entries may take seconds, so it is logged."""


def restore(
    record: SessionRecord,
    entries: Sequence[EntryRecord],
    snapshot: SnapshotRecord | None,
    services: SessionServices,
) -> tuple[Session, UnfitError | None]:
    """The session, paused, and why its snapshot was not used (None if it was); in any thread.

    Raises `ReplayError` where the log cannot be replayed, `ConfigError` or `TypeError` for an invalid
    configuration, `NewerRulesError` for rules of a newer version.
    """
    unfit: UnfitError | None = None
    if snapshot is not None:
        try:
            return _restore_snapshot(snapshot, record, entries, services), None
        except UnfitError as error:
            unfit = error
        except ReplayError as error:
            unfit = UnfitError(f"what follows it cannot be done: {error}")
    if len(entries) >= LONG_ENTRIES:
        why = str(unfit) if unfit is not None else "there is no snapshot of it"
        said = "a session is done again from all of its log; whoever asked for it waits, nobody else"
        _LOG.info(said, session=record.id, entries=len(entries), reason=why)
    session = Session(record, Timeline(saved_config(record.config)), services)
    replay(session, session.narrator, entries, record.tick)
    return session, unfit


def _restore_snapshot(
    snapshot: SnapshotRecord, record: SessionRecord, entries: Sequence[EntryRecord], services: SessionServices
) -> Session:
    frozen, position = unpack(snapshot, record, entries, services.settings.log_events)
    session = Session(record, frozen.timeline, services)
    frozen.apply_to(session)
    session.log_position.counted_work = frozen.timeline.worked
    replay(session, session.narrator, entries, record.tick, first=position)
    return session
