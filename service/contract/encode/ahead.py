"""What lies ahead, as JSON values: futures that were run, and what would change them."""

from __future__ import annotations

from typing import Any

from service.contract.encode.assurance import assurance_json
from service.contract.encode.confidence import confidence_json
from service.contract.encode.forecast import story_json
from sim.explain.ahead import Arrival, CrashAhead, StuckAhead
from sim.explain.avoidance import Avoidable
from sim.explain.coming_turn import ComingTurn
from sim.explain.foresight import Foresight
from sim.explain.planners import PlannerDrive
from sim.explain.repair import Repair
from sim.explain.safe_move import SafeMove
from sim.oracle.outlook import Outlook
from sim.types import Move
from sim.world import Cause

Json = dict[str, Any]


def foresight_json(seen: Foresight) -> Json:
    """One run to the end, with the chances where how others react is left to chance."""
    found = seen.chances
    return {
        "arrives": seen.arrives,
        "crashes": seen.crashes,
        "futures": None if found is None else found.futures,
        "left_to_chance": found is not None,
        "run": story_json(seen.story),
    }


def drive_json(drive: PlannerDrive) -> Json:
    """A planner from a moment on."""
    return {"planner": drive.planner, "first": drive.first, **foresight_json(drive.foresight)}


def safe_move_json(found: SafeMove) -> Json:
    """Whether a move is safe."""
    return {
        "move": found.move,
        "safe": found.safe,
        "proved": found.proved,
        "off_road": found.off_road,
        "hit": None if found.hit is None else _cause_json(found.hit),
        "then": None if found.then is None else foresight_json(found.then),
        "open": found.open,
        "assurance": assurance_json(found.assurance),
    }


def arrival_json(found: Arrival) -> Json:
    """When the ego arrives."""
    return {
        **confidence_json(found.confidence),
        "run": story_json(found.foresight.story),
        "instead": None if found.instead is None else drive_json(found.instead),
        "plan": _plan_json(found.plan),
    }


def crash_ahead_json(found: CrashAhead) -> Json:
    """Whether the ego crashes."""
    return {"ahead": foresight_json(found.foresight), "avoidable": avoidable_json(found.avoidable)}


def stuck_json(found: StuckAhead) -> Json:
    """Whether the ego is stuck."""
    return {
        "stuck": found.stuck,
        "ahead": foresight_json(found.foresight),
        "outlook": _outlook_json(found.outlook),
        "plan": _plan_json(found.plan),
    }


def repair_json(found: Repair) -> Json:
    """What would help; `removed` are ids."""
    return {
        "reached": found.reached,
        "removed": list(found.removed),
        "searched": found.searched,
        "tried": found.tried,
        "then": None if found.then is None else foresight_json(found.then),
        "planner": None if found.planner is None else drive_json(found.planner),
        "wish": found.wish,
        "outlook": _outlook_json(found.outlook),
    }


def avoidable_json(found: Avoidable) -> Json:
    """The last move instead of which another keeps clear; `proved`: whether that is known."""
    last = found.last
    told = None
    if last is not None:
        told = {"tick": last.tick, "made": last.made, "instead": last.instead, "stays": last.stays}
    return {"last": told, "proved": found.proved}


def _outlook_json(found: Outlook | None) -> Json | None:
    if found is None:
        return None
    return {"open": found.open, "late": found.late, "ids": list(found.ids), "minimal": found.minimal}


def _plan_json(plan: tuple[Move, ...] | None) -> list[str] | None:
    return None if plan is None else [str(move) for move in plan]


def _cause_json(cause: Cause) -> Json:
    return {"ids": list(cause.ids), "how": cause.how, "kind": cause.kind, "cell": list(cause.cell)}


def coming_turn_json(found: ComingTurn) -> Json:
    """The next stop or change of lanes in one run; null where there is none."""
    return {
        "move": found.move,
        "after": found.after,
        "at_tick": None if found.after is None else found.state.world.tick + found.after,
        "ids": [] if found.detour is None else list(found.detour.ids),
        "left_to_chance": found.chance,
        "run": story_json(found.story),
    }
