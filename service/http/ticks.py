"""Ticks in requests: one that has not come yet is refused."""

from __future__ import annotations

from service.http.validation import invalid
from service.problems import FieldProblem


def check_tick(tick: int | None, now: int, field: str = "tick") -> None:
    """Raises `Invalid` if a tick is later than the session's present one."""
    if tick is not None and tick > now:
        raise invalid([FieldProblem(field, f"has not come yet: it is tick {now}")])
