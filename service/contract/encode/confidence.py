"""How sure it is to arrive, as JSON values: the share, its origin, and how clear the last move was."""

from __future__ import annotations

from typing import Any

from sim.explain.confidence import Clarity, Confidence

Json = dict[str, Any]


def confidence_json(found: Confidence) -> Json:
    """Shares from 0 to 1; ticks from now. `confidence` and `interval` as in an advice."""
    return {
        "confidence": found.stated,
        "interval": [found.low, found.high],
        "method": found.method,
        "futures": found.futures,
        "decisions": found.decisions,
        "ends": {
            "arrives": found.arrives,
            "crashes": found.crashes,
            "stuck": found.stuck,
            "shut_off": found.shut_off,
        },
        "arrival_ticks": found.arrival_ticks,
        "end_ticks": found.end_ticks,
        "left_to_chance": found.chance,
        "by_hand": found.by_hand,
        "clarity": None if found.clarity is None else _clarity_json(found.clarity),
    }


def _clarity_json(clarity: Clarity) -> Json:
    return {
        "tick": clarity.decision.tick,
        "move": clarity.decision.move,
        "measure": clarity.decision.measure,
        "cost": clarity.decision.chosen.cost,
        "next_best": clarity.next_best,
        "gap": clarity.gap,
        "free_moves": clarity.free,
    }
