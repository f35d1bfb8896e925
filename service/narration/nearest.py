"""The nearest thing that is seen."""

from __future__ import annotations

from sim.decide import sense
from sim.explain.scene import describe_percept
from sim.state import SimState


def nearest_seen(state: SimState) -> str | None:
    """The id of the nearest thing that is seen, by cells across or along the road; None for none."""
    seen = describe_percept(sense(state)[0], state.config).seen
    if not seen:
        return None
    return min(seen, key=lambda thing: (max(abs(thing.lanes), abs(thing.rows)), thing.rows < 0)).id
