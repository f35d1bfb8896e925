"""The service with small limits, so that a short walk comes to what otherwise only a long session does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch

MOST_JUMPS = 3
MOST_NAMES = 2


@contextmanager
def limits() -> Iterator[None]:
    """Few states kept on the way, few moves in time and names, work beside the loop, thinned snapshots."""
    few = {
        "sim.session.timeline.SNAPSHOT_TICKS": 6,
        "sim.session.timeline.MAX_SNAPSHOTS": 6,
        "sim.session.timeline.RECENT_RUNS": 2,
        "sim.session.timeline.RECENT_CHANGES": 1,
        "service.sessions.undo_stack.MAX_JUMPS": MOST_JUMPS,
        "service.sessions.action_handlers.MAX_BOOKMARKS": MOST_NAMES,
        "service.work.executor.INLINE": 800,
        "service.sessions.persistence.snapshot_codec.MAX_STATES": 8,
        "service.sessions.persistence.snapshot_codec.ACTIONS_PER_CALL": 2,
    }
    patches = [patch(name, value) for name, value in few.items()]
    try:
        for each in patches:
            each.start()
        yield
    finally:
        for each in patches:
            each.stop()
