"""Tells the session that asked for an evaluation what came of it, as a line of its log."""

from __future__ import annotations

from collections.abc import Callable

from service.evaluations.view import view_of
from service.sessions.manager import SessionManager
from service.store import JobRecord


def announcer(manager: SessionManager) -> Callable[[JobRecord], None]:
    """What tells of a job that is done; a session that is not live is not told."""

    def announce(record: JobRecord) -> None:
        session = manager.live_sessions.get(str(record.spec.get("session")))
        if session is None or session.closed or record.result is None:
            return
        view = view_of(record.kind, record.spec, session.language)
        session.announce("event", None, view.ended(record.result, record.id))

    return announce
