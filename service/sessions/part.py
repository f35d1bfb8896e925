"""Parts of a session, which know it without keeping it.

A session that nobody uses any more is freed at once, with its past, rather than when garbage is looked for.
"""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from service.sessions.session import Session


class SessionPart:
    """A part of one session. For the event loop's thread only."""

    def __init__(self, session: Session) -> None:
        self._whole = weakref.ref(session)

    @property
    def _session(self) -> Session:
        """The session. Raises `ReferenceError` where nobody has it any more."""
        session = self._whole()
        if session is None:
            raise ReferenceError("the session is gone")
        return session
