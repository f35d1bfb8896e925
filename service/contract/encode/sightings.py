"""What was detected in a drive as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.sightings import Noticed, Sighting, Sightings

Json = dict[str, Any]


def sightings_json(found: Sightings) -> Json:
    """Each thing with the tick since which it was detected."""
    return {
        "first": found.first,
        "last": found.last,
        "sightings": [_sighting(each) for each in found.things],
    }


def noticed_json(found: Noticed) -> Json:
    """What was new at a tick, and what was lost."""
    return {"tick": found.state.world.tick, "new": list(found.new), "gone": list(found.gone)}


def _sighting(each: Sighting) -> Json:
    return {
        "id": each.id,
        "first_seen": each.first,
        "rows_ahead": None if each.first is None else each.rows,
        "lost": [list(stretch) for stretch in each.lost],
        "passed": each.passed,
    }
