"""Since when no way has been left, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.lost_way import LostWay

Json = dict[str, Any]


def lost_way_json(found: LostWay) -> Json:
    """The ticks, the moves, and what closes the way."""
    return {
        "looked_from": found.first,
        "got_no_further": found.state.world.tick,
        "open": found.open,
        "plan": None if found.plan is None else list(found.plan),
        "no_way_since": None if found.shut_at is None else found.shut_at.world.tick,
        "last_way_at": None if found.last_open is None else found.last_open.world.tick,
        "made": found.made,
        "instead": found.instead,
        "closed_by": [] if found.shut is None else list(found.shut.ids),
        "too_late": found.shut is not None and found.shut.late,
        "detected": found.detected,
        "noticed": found.noticed,
    }
