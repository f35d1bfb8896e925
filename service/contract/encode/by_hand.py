"""A person's driving beside a planner's, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.by_hand import ByHand
from sim.explain.hand_beside import HandBeside, Stretch

Json = dict[str, Any]


def hand_beside_json(found: HandBeside) -> Json:
    """Both stretches, and how each ends; ticks are those of the session."""
    return {
        "from_tick": found.took,
        "to_tick": found.now,
        "planner": found.planner,
        "you": _stretch_json(found.hand),
        "planner_instead": _stretch_json(found.other),
        "goes_on": {
            "you": {"outcome": found.hand_end[0], "tick": found.hand_end[1]},
            "planner": {"outcome": found.other_end[0], "tick": found.other_end[1]},
        },
    }


def _stretch_json(stretch: Stretch) -> Json:
    return {
        "outcome": stretch.outcome,
        "rows": stretch.rows,
        "rows_left": stretch.rows_left,
        "stops": stretch.stops,
        "lane_changes": stretch.changes,
        "gap_m": stretch.gap_m,
    }


def by_hand_json(found: ByHand) -> Json:
    """A person's part in the drive; `until_tick` is null while the person drives."""
    return {
        "since_tick": found.since,
        "until_tick": found.until,
        "moves": found.moves,
        "held_back": [{"tick": each.tick, "asked": each.asked} for each in found.held_back],
        "planner_would": found.would,
    }
