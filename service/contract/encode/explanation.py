"""The structured part of an explanation as JSON values: all that its words were made from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service import actions as contract
from service.contract.encode.decision import options_json
from sim.explain import Alternatives, Cause, Counterfactual, Explanation, Future
from sim.explain.avoidance import Avoidable
from sim.explain.crash import Crash, LastAvoidance

Json = dict[str, Any]


def explanation_json(explanation: Explanation, texts: Sequence[str]) -> Json:
    """Causes, alternatives, proofs; every `change` is a list of actions to try it with at that tick.

    `texts`: one for each option of the decision.
    """
    decision, verified = explanation.decision, explanation.verified
    flips = [_flip_json(flip, decision.tick) for flip in explanation.counterfactuals]
    return {
        "tick": decision.tick,
        "move": decision.move,
        "foil": explanation.foil,
        "causes": [_cause_json(cause, explanation) for cause in explanation.causes],
        "chain": [
            {
                "blocker": link.blocker,
                "by": link.by,
                "move": link.move,
                "behind": link.behind,
                **({} if link.leads is None else {"leads": link.leads}),
            }
            for link in explanation.chain
        ],
        "shown": _shown_json(explanation),
        "alternatives": options_json(decision, texts),
        "verified": {
            "necessary": verified.necessary,
            "sufficient": verified.sufficient,
            "minimal": verified.minimal,
        },
        "counterfactual": flips[0] if flips else None,
        "stakes": None if explanation.stakes is None else stakes_json(explanation.stakes),
        "evidence": {
            "counterfactuals": flips,
            "reruns": explanation.reruns,
            **({"untried": explanation.untried} if explanation.untried else {}),
        },
    }


def crash_json(crash: Crash, texts: Sequence[str]) -> Json:
    """The explanation of the last tick, and with its evidence what happened and what would have saved it."""
    told = explanation_json(crash.explanation, texts)
    told["evidence"]["crash"] = {
        "tick": crash.end,
        "how": crash.cause.how,
        "kind": crash.cause.kind,
        "ids": crash.cause.ids,
        "cell": crash.cause.cell,
        "free": crash.free,
        "certain": crash.certain,
        "looked_back": crash.looked_back,
        "whole": crash.whole,
        "saving": None if crash.saving is None else _saving_json(crash.saving),
        "avoidable": _avoidable_json(crash.avoidable),
        **({"missed": crash.missed} if crash.missed else {}),
    }
    return told


def _avoidable_json(avoidable: Avoidable) -> Json | None:
    """None where it is not known; `last` is None where it is proved that nothing could have been done."""
    if avoidable.last is None:
        return {"last": None} if avoidable.proved else None
    last = avoidable.last
    return {"last": {"tick": last.tick, "made": last.made, "instead": last.instead, "stays": last.stays}}


def _saving_json(saving: LastAvoidance) -> Json:
    return {
        "tick": saving.tick,
        "made": saving.made,
        "instead": saving.instead,
        "ticks": saving.ticks,
    }


def _cause_json(cause: Cause, explanation: Explanation) -> Json:
    return {
        "id": cause.id,
        "kind": cause.kind,
        "cell": cause.cell,
        "distance_m": None if cause.cell is None else _distance(cause.cell, explanation),
        "role": cause.role,
        "moves": cause.moves,
        "necessary": cause.necessary,
        "group": cause.group,
        "each_enough": cause.each_enough,
        **({} if cause.real else {"real": False}),
    }


def _shown_json(explanation: Explanation) -> Json:
    """What to point at while it is read, where it stood: the causes, what blocked the foil, the chain."""
    ids = [cause.id for cause in (*explanation.causes, *explanation.also) if cause.cell is not None]
    ids += [name for link in explanation.chain for name in (link.blocker, link.by) if name]
    if explanation.foil is not None:
        ids += explanation.decision.option(explanation.foil).causes
    world = explanation.moment.world
    told = {cause.id: cause.cell for cause in (*explanation.causes, *explanation.also)}
    there = {name: thing.cell for name in ids if (thing := world.find(name)) is not None}
    cells = [cell for name in dict.fromkeys(ids) if (cell := told.get(name) or there.get(name)) is not None]
    return {"ids": list(dict.fromkeys(ids)), "cells": cells}


def _distance(cell: tuple[int, int], explanation: Explanation) -> float:
    """Metres from the vehicle that decided, lanes and rows alike."""
    moment = explanation.moment
    own = moment.world.avs[moment.number(explanation.decision.av)]
    column, row = moment.world.road.cell(own)
    return max(abs(cell[0] - column), abs(cell[1] - row)) * moment.config.cell_m


def _flip_json(flip: Counterfactual, tick: int) -> Json:
    """A change that flips the decision; `at_tick` is where a fork must begin to see it.

    `undetected`: ids that must not be seen either, which no fork can bring about.
    """
    told = {"at_tick": tick, "change": contract.dump(flip.change), "decision": flip.move}
    return told | ({"undetected": flip.undetected} if flip.undetected else {})


def stakes_json(stakes: Alternatives) -> Json:
    """A move that was not made, beside the one that was."""
    return {
        "foil": stakes.foil,
        "would": None if stakes.would is None else _future_json(stakes.would),
        "real": None if stakes.real is None else _future_json(stakes.real),
        "ticks_lost": stakes.ticks_lost,
        "dead_end": stakes.dead_end,
    }


def _future_json(future: Future) -> Json:
    return {"outcome": future.outcome, "ticks": future.ticks, "ids": future.ids}
