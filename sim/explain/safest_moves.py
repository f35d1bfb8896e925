"""Which of the moves that can be made now is the safest: each is run, and what comes after it."""

from __future__ import annotations

from typing import Final

from sim.explain.assurance import Level
from sim.explain.safe_move import SafeMove, safe_move
from sim.session.timeline import Timeline
from sim.types import Move

_LEVELS: Final = (Level.WHATEVER, Level.LIKELY, Level.POSSIBLE, Level.NONE)
"""The surest first."""


def safety(found: SafeMove) -> tuple[bool, bool, float, int, bool]:
    """How unsafe a move is, the least first.

    By whether it can be made, whether it hits something, its share of crashes after it, how sure it is to
    keep clear, and whether it leaves no way to the goal.
    """
    level = Level.NONE if found.assurance is None else found.assurance.level
    crashes = 1.0 if found.then is None else found.then.crashes
    return found.off_road, found.then is None, crashes, _LEVELS.index(level), found.open is False


def safest_moves(timeline: Timeline) -> tuple[SafeMove, ...]:
    """All moves, the safest first. Raises `QuestionError`."""
    return tuple(sorted((safe_move(timeline, move) for move in Move), key=safety))
