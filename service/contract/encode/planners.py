"""What planners would do, as JSON values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from service.contract.encode.ahead import drive_json, foresight_json
from service.contract.encode.decision import options_json
from sim.explain.own_move import OwnMove
from sim.explain.planner_character import Character, command
from sim.explain.planners import Parting, PlannersHere
from sim.plan import Decision

Json = dict[str, Any]
Texts = tuple[Sequence[str], Sequence[str]]
_NO_TEXTS: Texts = ((), ())


def planners_json(found: PlannersHere, parting: Parting | None = None, texts: Texts = _NO_TEXTS) -> Json:
    """Each planner from here on; `parts_after`: moves that are the same before it drives otherwise.

    `parting`: what both decide there, where one planner is compared with the one that drives; `texts`: one
    for each of their options.
    """
    others = [drive_json(each) | {"parts_after": found.parting(each)} for each in found.others]
    return {
        "own": drive_json(found.own),
        "others": others,
        "missing": list(found.missing),
        "best": [each.planner for each in found.best],
        "parting": None
        if parting is None
        else {
            "at_tick": parting.tick,
            "own": _decision_json(parting.own, texts[0]),
            "other": _decision_json(parting.other, texts[1]),
        },
    }


def _decision_json(decision: Decision, texts: Sequence[str]) -> Json:
    return {
        "planner": decision.planner,
        "move": decision.move,
        "options": options_json(decision, texts),
    }


def character_json(found: Character | None) -> Json:
    """The figures of a planner, and the command that made them."""
    return {"character": None if found is None else asdict(found), "command": command()}


def ranked_json(found: Sequence[Character]) -> Json:
    """The figures of all planners that were counted, and the command that made them."""
    return {"characters": [asdict(each) for each in found], "command": command()}


def own_move_json(found: OwnMove) -> Json:
    """A move beside the planner's."""
    lost = found.regret
    return {
        "at_tick": found.made.tick,
        "made": found.made.move,
        "would": found.would,
        "by_person": found.by_person,
        "good": found.good,
        "after_made": foresight_json(found.after_made),
        "after_would": foresight_json(found.after_would),
        "regret": None if lost is None else {"ticks": lost.ticks, "cost": lost.cost, "lost": lost.lost},
    }
