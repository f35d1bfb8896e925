"""Near misses and the risk of a move, as JSON values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sim.explain.closest_call import NEAR_MISS_M, ClosestCall
from sim.explain.riskiest import Risk

Json = dict[str, Any]


def near_misses_json(found: Sequence[ClosestCall], stretch: tuple[int, int] | None) -> Json:
    """Each near miss in its order; `stretch`: the ticks that were looked at, None where none were."""
    first, last = stretch or (None, None)
    return {
        "first": first,
        "last": last,
        "limit_m": NEAR_MISS_M,
        "near_misses": [_call_json(call) for call in found],
    }


def move_risk_json(found: Risk) -> Json:
    """A move, what came nearest in its tick, and the moves that would have met nothing."""
    return {
        "at_tick": found.tick,
        "made": found.made,
        "crashed": found.crashed,
        "free": list(found.free),
        "tried": list(found.tried),
        "nearest": None if found.call is None else _call_json(found.call),
    }


def _call_json(call: ClosestCall) -> Json:
    return {
        "tick": call.tick,
        "id": call.id,
        "gap_m": call.gap_m,
        "ttc_s": call.ttc_s,
        "near_miss": call.near_miss,
    }
