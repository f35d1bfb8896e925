"""A drive as a whole as JSON values: what was counted, what was left behind, how well it went."""

from __future__ import annotations

from typing import Any

from sim.explain.losses import Losses
from sim.explain.occurrences import Occurrence, Occurrences
from sim.explain.passed import Passed
from sim.explain.riskiest import Risk
from sim.explain.tight_moments import TightMoments
from sim.explain.waits import Waits
from sim.state import SimState

Json = dict[str, Any]


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


def occurrences_json(found: Occurrences, what: str) -> Json:
    """What was counted, in its order; `ids` is null where it was not looked for what one was for.

    Lanes are told the longest first; lane 1 is the leftmost.
    """
    facts: Json = {"first": found.first, "last": found.last, "driven": found.driven}
    if what == "lanes_used":
        return facts | {"lanes": [{"lane": lane, "ticks": ticks} for lane, ticks in found.lanes]}
    return facts | {_NAMES[what]: [_occurrence_json(each, what) for each in found.found]}


def _occurrence_json(each: Occurrence, what: str) -> Json:
    told: Json = {"tick": each.tick}
    if what == "lane_changes":
        told |= {"side": "left" if each.left else "right", "diagonal": each.diagonal}
    if what in ("stopped", "moving"):
        told["ticks"] = each.ticks
    if what == "ended":
        told["outcome"] = each.before.world.outcome
    if what in ("made", "shares", "listed", "in_the_way"):
        told["move"] = each.move
    if what != "lane_changes" or each.ids is not None:
        told["ids"] = None if each.ids is None else list(each.ids)
    return told


_NAMES = {
    "stopped": "stops",
    "lane_changes": "lane_changes",
    "made": "moves",
    "shares": "moves",
    "listed": "moves",
    "in_the_way": "moves",
    "moving": "stretches",
    "ended": "ends",
}
"""By what is asked, the name of the list of what was found."""


def tight_json(found: TightMoments) -> Json:
    """The ticks in which one move was free, and those in which none was."""
    return {
        "first": found.first,
        "judged": found.judged,
        "one_free": [each.tick for each in found.one],
        "none_free": [each.tick for each in found.none],
    }
