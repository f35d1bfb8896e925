"""What planners would do, as JSON values."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from service.contract.encode.ahead import drive_json, foresight_json
from sim.explain.own_move import OwnMove
from sim.explain.planner_character import Character, command
from sim.explain.planners import PlannersHere

Json = dict[str, Any]


def planners_json(found: PlannersHere) -> Json:
    """Each planner from here on; `parts_after`: moves that are the same before it drives otherwise."""
    others = [drive_json(each) | {"parts_after": found.parting(each)} for each in found.others]
    return {
        "own": drive_json(found.own),
        "others": others,
        "missing": list(found.missing),
        "best": [each.planner for each in found.best],
    }


def character_json(found: Character | None) -> Json:
    """The figures of a planner, and the command that made them."""
    return {"character": None if found is None else asdict(found), "command": command()}


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
