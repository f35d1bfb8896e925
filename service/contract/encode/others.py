"""Where other road users go, and what one that was hit did, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.hit_mover import HitMovers
from sim.explain.others_ahead import Crossing, OthersAhead

Json = dict[str, Any]


def others_json(found: OthersAhead) -> Json:
    """Each with the step that it takes next."""
    return {"others": [{"id": thing.id, "kind": thing.kind, "move": move} for thing, move in found.ways]}


def crossing_json(found: Crossing) -> Json:
    """Who comes into the lane, each after so many ticks."""
    return {"ticks": found.ticks, "coming": [{"id": id, "after": after} for id, after in found.coming]}


def hit_movers_json(found: HitMovers) -> Json:
    """What was hit, and how it moved in the tick of the crash."""
    return {
        "tick": found.crash.end,
        "hit": [
            {
                "id": each.id,
                "kind": each.kind,
                "move": each.move,
                "lanes_to_my_right": each.across,
                "speed_kmh": each.speed_kmh,
                "clear_if_stayed": each.clear_if_stayed,
            }
            for each in found.found
        ],
    }
