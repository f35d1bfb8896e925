"""Questions about the past as JSON values: other moves, other road users, patterns, moments."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service.contract.encode.decision import options_json
from service.contract.encode.explanation import stakes_json
from sim.explain.other_move import OtherMove
from sim.explain.other_movers import MoverMove, MoverWay
from sim.explain.pattern import Pattern
from sim.explain.riskiest import Risk
from sim.explain.similar import Similar
from sim.world import Thing

Json = dict[str, Any]


def shown_json(things: Sequence[Thing]) -> Json:
    """What to point at while an answer is read, and where it stood."""
    return {"ids": [thing.id for thing in things], "cells": [thing.cell for thing in things]}


def move_json(found: OtherMove) -> Json:
    """A move that was not made, and both futures; `play` is how a fork taken at that tick shows it."""
    explanation, stakes = found.explanation, found.stakes
    decision = explanation.decision
    hit = {*stakes.would.ids} if stakes.would is not None else set()
    world = explanation.moment.world
    there = [thing for name in sorted(hit) if (thing := world.find(name)) is not None]
    return {
        "tick": decision.tick,
        "move": decision.move,
        "foil": stakes.foil,
        "causes": [{"id": each.id, "kind": each.kind, "cell": each.cell, "role": "blocks"} for each in there],
        "alternatives": options_json(decision, [""] * len(decision.options)),
        "shown": shown_json(there),
        "stakes": stakes_json(stakes),
        "play": {"at_tick": decision.tick, "move": stakes.foil},
        "said_since": found.said_since,
        "evidence": {"reruns": explanation.reruns},
    }


def mover_json(found: MoverMove) -> Json:
    """What a mover did in a tick, and why."""
    world = found.before.world
    blockers = [thing for name in found.ids if (thing := world.find(name)) is not None]
    return {
        "tick": found.tick,
        "mover": {"id": found.id, "kind": found.was.kind, "from": found.was.cell, "to": found.now.cell},
        "move": found.move,
        "turned": found.turned,
        "shown": shown_json([found.was, *blockers]),
        "reason": found.reason,
        "causes": [
            {
                "id": each.id,
                "kind": each.kind,
                "cell": each.cell,
                "role": "blocks",
                "necessary": not found.together,
            }
            for each in blockers
        ],
        "otherwise": None
        if found.otherwise is None
        else {"cell": found.otherwise.cell, "heading": found.otherwise.heading},
        "evidence": {"reruns": found.reruns},
    }


def way_of_mover_json(found: MoverWay) -> Json:
    """Where a mover goes."""
    turn = None if found.turn is None else mover_json(found.turn)
    return {
        "mover": {"id": found.id},
        "steps": found.steps,
        "cell": list(found.cell),
        "turn": turn,
        "causes": [] if turn is None else turn["causes"],
        "shown": shown_json([thing] if (thing := found.state.world.find(found.id)) is not None else []),
        "by_chance": found.by_chance,
    }


def pattern_json(found: Pattern) -> Json:
    """How often a move was made, and what stood behind it."""
    return {
        "move": found.move,
        "first": found.first,
        "last": found.last,
        "made": found.made,
        "decided": found.decided,
        "instances": [
            {"tick": each.tick, "ids": each.ids, "rather": each.rather} for each in found.instances
        ],
        "evidence": {"reruns": len(found.instances)},
    }


def risk_json(found: Risk) -> Json:
    """How risky a tick was."""
    return {
        "moment": found.tick,
        "made": found.made,
        "crashed": found.crashed,
        "free": found.free,
        "tried": found.tried,
        "clearance": None if found.call is None else {"id": found.call.id, "gap_m": found.call.gap_m},
    }


def similar_json(found: Similar) -> Json:
    """Moments that are like one."""
    return {
        "moment": found.before.world.tick,
        "made": found.move,
        "searched": found.searched,
        "moments": [
            {
                "tick": each.tick,
                "alike": round(each.alike, 3),
                "shared": [
                    {"across": across, "ahead": ahead, "kind": kind} for (across, ahead), kind in each.shared
                ],
            }
            for each in found.found
        ],
    }
