"""A counterfactual beside the real run as JSON values: a state each, then what moved, tick by tick."""

from __future__ import annotations

from typing import Any

from service.contract.encode.decision import brief_decision_json
from service.contract.encode.state import SessionStatus, cause_json, state_json
from service.sessions.facts import SideBySideTexts
from service.sessions.messages import motion_json
from sim.explain.side_by_side import Side, SideBySide
from sim.state import SimState, StepResult

Json = dict[str, Any]


def beside_json(
    status: SessionStatus, found: SideBySide, most: int, texts: SideBySideTexts, parting: Json | None = None
) -> Json:
    """Both runs, at most so many ticks of each."""
    return {
        "at_tick": found.tick,
        "instead_of": found.instead_of,
        "text": texts.difference,
        "said_since": found.said_since,
        "real": _side_json(status, found.real, most, texts.real_end),
        "changed": _side_json(status, found.changed, most, texts.changed_end),
        "parting": parting,
    }


def _side_json(status: SessionStatus, side: Side, most: int, text: str) -> Json:
    story = side.story
    end = {
        "outcome": story.outcome,
        "tick": story.end,
        "driven": story.driven,
        "waited": story.waited,
        "by_hand": story.by_hand,
        "cause": cause_json(side.ticks[-1][1].state.world) if side.ticks else None,
        "digest": story.digest,
        "text": text,
    }
    ticks = [_tick_json(status, before, tick) for before, tick in side.ticks[:most]]
    return {"state": state_json(status, side.start), "ticks": ticks, "end": end}


def _tick_json(status: SessionStatus, before: SimState, tick: StepResult) -> Json:
    world = tick.state.world
    told: Json = {"tick": world.tick, "episode": world.episode, "status": world.outcome}
    if world.episode != before.world.episode:
        told["state"] = state_json(status, tick.state)
    else:
        told |= motion_json(before.world, world)
    decision = tick.decision
    return told | {
        "decision": None if decision is None else brief_decision_json(decision),
        "cause": cause_json(world),
    }
