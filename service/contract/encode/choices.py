"""The moves of a decision, what a coming one hangs on, and what past ones have cost, as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.coming_move import ComingMove
from sim.explain.losses import Losses
from sim.forecast import StepVerdict
from sim.plan import Decision

Json = dict[str, Any]


def choices_json(decision: Decision) -> Json:
    """Which moves of a decision meet nothing, and what the others would meet."""
    free = [option.move for option in decision.options if option.reason is StepVerdict.FREE]
    return {
        "at_tick": decision.tick,
        "made": decision.move,
        "free": free,
        "blocked": [
            {"move": option.move, "reason": option.reason, "causes": option.causes}
            for option in decision.options
            if option.move not in free
        ],
    }


def matters_json(found: ComingMove) -> Json:
    """What the coming move hangs on."""
    return {
        "move": found.decision.move,
        "flips": [{"without": flip.ids, "move": flip.move} for flip in found.flips],
        "untried": list(found.explanation.untried),
        "evidence": {"reruns": found.explanation.reruns},
    }


def losses_json(found: Losses) -> Json:
    """What the decisions of an episode have cost."""
    return {
        "first": found.first,
        "last": found.last,
        "judged": found.judged,
        "unknown": found.unknown,
        "ticks_lost": found.ticks,
        "losses": [{"tick": each.tick, "move": each.move, "ticks": each.ticks} for each in found.found],
    }
