"""A drive as a whole as JSON values: lane changes, what was left behind, how well it went."""

from __future__ import annotations

from typing import Any

from sim.explain.lane_changes import LaneChanges
from sim.explain.lanes_used import LanesUsed
from sim.explain.losses import Losses
from sim.explain.passed import Passed
from sim.explain.riskiest import Risk
from sim.explain.stops import Stops
from sim.explain.tight_moments import TightMoments
from sim.explain.waits import Waits
from sim.state import SimState

Json = dict[str, Any]


def lane_changes_json(found: LaneChanges) -> Json:
    """Lane changes of an episode, in their order."""
    return {
        "lane_changes": [
            {"tick": each.tick, "side": "left" if each.left else "right", "diagonal": each.diagonal}
            for each in found.found
        ]
    }


def passed_json(found: Passed) -> Json:
    """The ids of what was left behind, by kind."""
    return {"passed": {kind.value: list(ids) for kind, ids in found.ids.items()}}


def verdict_json(state: SimState, waited: Waits, lost: Losses | None, risk: Risk | None) -> Json:
    """How well a drive went, in ticks; `lost` is null where it cannot be told."""
    return {
        "outcome": state.world.outcome,
        "driven": waited.driven,
        "waited": waited.total,
        "lost": None if lost is None or lost.unknown else lost.ticks,
        "tightest": None
        if risk is None
        else {"tick": risk.tick, "free": len(risk.free), "tried": len(risk.tried)},
    }


def stops_json(found: Stops) -> Json:
    """Stops of an episode, in their order; `ids` is null where it was not looked for what one was for."""
    return {
        "driven": found.driven,
        "stops": [
            {"tick": each.tick, "ticks": each.ticks, "ids": None if each.ids is None else list(each.ids)}
            for each in found.found
        ],
    }


def lanes_used_json(found: LanesUsed) -> Json:
    """Ticks in each lane, the longest first; lane 1 is the leftmost."""
    return {"driven": found.driven, "lanes": [{"lane": lane, "ticks": ticks} for lane, ticks in found.ticks]}


def tight_json(found: TightMoments) -> Json:
    """The ticks in which one move was free, and those in which none was."""
    return {
        "first": found.first,
        "judged": found.judged,
        "one_free": [each.tick for each in found.one],
        "none_free": [each.tick for each in found.none],
    }
