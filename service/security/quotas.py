"""How much one client may have at once: sessions, and cells of road over all of them.

Counted are sessions made since the service started; those that were there before are nobody's.
"""

from __future__ import annotations

from collections.abc import Mapping

from service.problems import QuotaExceeded


class Quotas:
    """What each client has; None is no limit."""

    def __init__(self, sessions: int | None, cells: int | None) -> None:
        self._most_sessions = sessions
        self._most_cells = cells
        self._cells: dict[str, dict[str, int]] = {}
        self._making: dict[str, int] = {}
        self._owner: dict[str, str] = {}

    @property
    def kept(self) -> bool:
        """Whether there is any limit at all."""
        return self._most_sessions is not None or self._most_cells is not None

    def begin(self, owner: str) -> None:
        """Before a session is made; to be ended by `end`. Raises `QuotaExceeded`."""
        has: Mapping[str, int] = self._cells.get(owner, {})
        making = self._making.get(owner, 0)
        if self._most_sessions is not None and len(has) + making >= self._most_sessions:
            raise QuotaExceeded(
                f"You have {len(has) + making} sessions, and {self._most_sessions} is the most for one "
                "client here. Delete one and try again."
            )
        if self._most_cells is not None and sum(has.values()) >= self._most_cells:
            raise QuotaExceeded(
                f"Your roads have {sum(has.values())} cells together, and {self._most_cells} is the most for "
                "one client here. Delete a session and try again."
            )
        self._making[owner] = making + 1

    def end(self, owner: str, session_id: str | None, cells: int) -> None:
        """After it was made, or not (None)."""
        left = self._making.get(owner, 1) - 1
        if left:
            self._making[owner] = left
        else:
            self._making.pop(owner, None)
        if session_id is not None:
            self._cells.setdefault(owner, {})[session_id] = cells
            self._owner[session_id] = owner

    def gone(self, session_id: str) -> None:
        """A session was deleted, by whomever."""
        owner = self._owner.pop(session_id, None)
        if owner is not None:
            has = self._cells[owner]
            del has[session_id]
            if not has:
                del self._cells[owner]
