"""The near future and the last ticks of the past as JSON values."""

from __future__ import annotations

from typing import Any

from service.contract.encode.assurance import assurance_json
from service.contract.encode.past import shown_json
from sim.explain.before_crash import BeforeCrash
from sim.explain.differing import ManualDrive
from sim.explain.ranking import Ranking
from sim.explain.soon import ComingTicks, RiskNow
from sim.explain.waits import Waits

Json = dict[str, Any]


def ranking_json(found: Ranking) -> Json:
    """The moves of a decision, the best first; costs are in the decision's measure."""
    decision, second = found.decision, found.runner_up
    return {
        "at_tick": decision.tick,
        "measure": decision.measure,
        "made": decision.move,
        "second": None if second is None else second.move,
        "gap": found.gap,
        "options": [
            {
                "move": option.move,
                "verdict": option.verdict,
                "reason": option.reason,
                "cost": option.cost,
                "causes": option.causes,
            }
            for option in decision.options
        ],
    }


def risk_json(found: RiskNow, nearest: str | None) -> Json:
    """How safe it is now: shares of futures from 0 to 1."""
    sure = found.confidence
    return {
        "crashes": sure.crashes,
        "method": sure.method,
        "futures": sure.futures,
        "nearest": nearest,
        "staying_is_safe": None if found.stay is None else found.stay.safe,
        "assurance": assurance_json(found.assurance),
        "evidence": {"decisions": sure.decisions},
    }


def coming_json(found: ComingTicks) -> Json:
    """What happens in the next ticks."""
    return {
        "ticks": found.ticks,
        "moves": found.story.path,
        "outcome": found.story.outcome,
        "crashes": found.crashes,
        "arrives": found.arrives,
        "futures": found.futures,
        "left_to_chance": found.branched,
    }


def waits_json(found: Waits) -> Json:
    """How long it has waited, in ticks."""
    return {"waited": {"now": found.now, "since": found.since, "total": found.total, "driven": found.driven}}


def differing_json(found: ManualDrive) -> Json:
    """Moves of a person that the planner would not have made."""
    return {
        "first": found.first,
        "last": found.last,
        "by_hand": found.by_hand,
        "unknown": found.unknown,
        "differing": [{"tick": each.tick, "made": each.made, "would": each.would} for each in found.found],
    }


def before_crash_json(found: BeforeCrash) -> Json:
    """The last ticks before a crash; `moment` is the tick of its last decision."""
    thing = found.thing
    return {
        "moment": found.before.world.tick,
        "crash_tick": found.tick,
        "shown": shown_json([] if thing is None else [thing]),
        "theirs": found.theirs,
        "own": found.own,
    }
