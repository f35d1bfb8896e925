"""A counterfactual beside the real run as JSON values: a state each, then what moved, tick by tick."""

from __future__ import annotations

from typing import Any

from service.contract.encode.decision import brief_decision_json
from service.contract.encode.state import Standing, cause_json, state_json
from service.sessions.messages import motion_json
from sim.explain.side_by_side import Side, SideBySide
from sim.state import SimState, StepResult

Json = dict[str, Any]


def beside_json(standing: Standing, found: SideBySide, most: int) -> Json:
    """Both runs, at most so many ticks of each."""
    return {
        "at_tick": found.tick,
        "instead_of": found.instead_of,
        "said_since": found.said_since,
        "real": _side_json(standing, found.real, most),
        "changed": _side_json(standing, found.changed, most),
    }


def _side_json(standing: Standing, side: Side, most: int) -> Json:
    story = side.story
    end = {
        "outcome": story.outcome,
        "tick": story.end,
        "driven": story.driven,
        "waited": story.waited,
        "by_hand": story.by_hand,
        "cause": cause_json(side.ticks[-1][1].state.world) if side.ticks else None,
        "digest": story.digest,
    }
    ticks = [_tick_json(standing, before, tick) for before, tick in side.ticks[:most]]
    return {"state": state_json(standing, side.start), "ticks": ticks, "end": end}


def _tick_json(standing: Standing, before: SimState, tick: StepResult) -> Json:
    world = tick.state.world
    told: Json = {"tick": world.tick, "episode": world.episode, "status": world.outcome}
    if world.episode != before.world.episode:
        told["state"] = state_json(standing, tick.state)
    else:
        told |= motion_json(before.world, world)
    decision = tick.decision
    return told | {
        "decision": None if decision is None else brief_decision_json(decision),
        "cause": cause_json(world),
    }
