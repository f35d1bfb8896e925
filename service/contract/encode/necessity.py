"""Whether a move was needed, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.alternatives import Future
from sim.explain.necessity import Necessity


def necessity_json(found: Necessity) -> dict[str, Any]:
    """A move beside the other one; ends count their ticks from the episode's start."""
    stakes = found.stakes
    return {
        "at_tick": found.decision.tick,
        "made": found.decision.move,
        "foil": found.foil,
        "need": found.need,
        "needed": found.needed,
        "hit": list(found.hit),
        "free": list(found.free),
        "stood": found.stood,
        "shut": found.shut,
        "would": None if stakes is None else _future(stakes.would),
        "real": None if stakes is None else _future(stakes.real),
        "ticks_lost": None if stakes is None else stakes.ticks_lost,
    }


def _future(found: Future | None) -> dict[str, Any] | None:
    return None if found is None else {"outcome": found.outcome, "ticks": found.ticks, "ids": list(found.ids)}
