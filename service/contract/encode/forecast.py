"""What will be, what would be, and what has come of it, as JSON values."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from service.actions import Action
from service.contract.encode.state import metrics_json
from sim.explain.episode_rollout import Detour, EpisodeRollout, RouteAhead
from sim.explain.what_if import WhatIf
from sim.session.edits import Applied
from sim.state import SimState
from sim.world import Cause, Thing

Json = dict[str, Any]


def what_if_json(asked: tuple[Action, ...], found: WhatIf) -> Json:
    """Both stories, where they part, and what a client needs to play the other beside the real one.

    `change` is what was asked; `play.actions` the part of it that makes a difference on the road, to be
    done to a fork taken at `play.at_tick`.
    """
    actions = contract.dump(tuple(each.action for each in found.done))
    difference, regret = found.first_difference, found.regret
    decision = found.changed.path[0] if found.changed.path else None
    return {
        "change": contract.dump(asked),
        "done": [_done_json(each) for each in found.done],
        "real": story_json(found.real),
        "changed": story_json(found.changed),
        "same_road": found.same_road,
        "first_difference": None
        if difference is None
        else {
            "tick": difference.tick,
            "ahead": difference.ahead,
            "real": difference.real,
            "changed": difference.changed,
        },
        "regret": None
        if regret is None
        else {
            "ticks": regret.ticks,
            "cost": regret.cost,
            "lost": regret.lost,
            "certain": found.certain,
        },
        "counterfactual": {"change": actions, "decision": decision},
        "play": {"at_tick": found.state.world.tick, "actions": actions},
        "evidence": {"reruns": len(found.real.path) + len(found.changed.path)},
    }


def story_json(story: EpisodeRollout) -> Json:
    """A run to the end of its episode."""
    return {
        "from_tick": story.tick,
        "waited": story.waited,
        "episode": story.episode,
        "end_tick": story.end,
        "ticks": story.ticks,
        "driven": story.driven,
        "outcome": story.outcome,
        "cause": _cause_json(story.cause),
        "moves": {str(move): count for move, count in story.moves().items()},
        "path": story.path,
        "detours": [detour_json(detour) for detour in story.detours],
        "held_back": story.held_back,
        "by_hand": story.by_hand,
        "silent": story.silent,
        "digest": story.digest,
    }


def way_json(way: RouteAhead) -> Json:
    """The next decisions, none of them taken yet."""
    return {
        "way": [{"tick": decision.tick, "move": decision.move} for decision in way.decisions],
        "detours": [detour_json(detour) for detour in way.detours],
        "outcome": way.outcome,
        "cause": _cause_json(way.cause),
        "offered": way.offered,
        "chance": way.chance,
    }


def figures_json(run: SimState, interval: tuple[float, float] | None) -> Json:
    """A session's figures, with the 95 % interval of its rate of arrivals where it is told."""
    return {"figures": metrics_json(run.metrics) | {"success_rate_interval": interval}}


def detour_json(detour: Detour) -> Json:
    """A move that was not straight on."""
    return {"tick": detour.tick, "move": detour.move, "sake": detour.sake, "ids": detour.ids}


def _done_json(applied: Applied) -> Json:
    return {
        "do": applied.action.do,
        "added": [_thing_json(thing) for thing in applied.added],
        "removed": [_thing_json(thing) for thing in applied.removed],
        "changes": applied.changes,
    }


def _thing_json(thing: Thing) -> Json:
    return {"id": thing.id, "kind": thing.kind, "cell": thing.cell}


def _cause_json(cause: Cause | None) -> Json | None:
    if cause is None:
        return None
    return {"kind": cause.kind, "how": cause.how, "ids": cause.ids, "cell": cause.cell}
