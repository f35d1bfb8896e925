"""Quotas: how many sessions, and cells of road over all of them, one client may have at once.

Counts the sessions made since the service started; sessions from before the start count for no client.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from service.problems import QuotaExceeded


class Reservation:
    """A session that is being made."""

    def __init__(self) -> None:
        self.session_id: str | None = None
        self.cells = 0

    def use(self, session_id: str, cells: int) -> None:
        """Counts the session that was made, with the cells of its road."""
        self.session_id, self.cells = session_id, cells


class Quotas:
    """What each client has. A limit of None means unlimited."""

    def __init__(self, max_sessions: int | None, max_cells: int | None) -> None:
        self._max_sessions = max_sessions
        self._max_cells = max_cells
        self._cells: dict[str, dict[str, int]] = {}
        self._making: dict[str, int] = {}
        self._owner: dict[str, str] = {}

    @contextmanager
    def reserve(self, owner: str) -> Iterator[Reservation]:
        """Counts a session while it is made, and from then on if it was. Raises `QuotaExceeded`."""
        reservation = Reservation()
        if self._max_sessions is None and self._max_cells is None:
            yield reservation
            return
        self._check(owner)
        self._making[owner] = self._making.get(owner, 0) + 1
        try:
            yield reservation
        finally:
            left = self._making[owner] - 1
            if left:
                self._making[owner] = left
            else:
                del self._making[owner]
            if reservation.session_id is not None:
                self._cells.setdefault(owner, {})[reservation.session_id] = reservation.cells
                self._owner[reservation.session_id] = owner

    def release(self, session_id: str) -> None:
        """Counts a session no more that was deleted, by whomever."""
        owner = self._owner.pop(session_id, None)
        if owner is not None:
            cells = self._cells[owner]
            del cells[session_id]
            if not cells:
                del self._cells[owner]

    def _check(self, owner: str) -> None:
        cells = self._cells.get(owner, {})
        sessions = len(cells) + self._making.get(owner, 0)
        if self._max_sessions is not None and sessions >= self._max_sessions:
            raise QuotaExceeded(
                f"You have {sessions} sessions, and {self._max_sessions} is the most for one "
                "client here. Delete one and try again."
            )
        if self._max_cells is not None and sum(cells.values()) >= self._max_cells:
            raise QuotaExceeded(
                f"Your roads have {sum(cells.values())} cells together, and {self._max_cells} is the most "
                "for one client here. Delete a session and try again."
            )
