"""Decisions as JSON values: with the whole trace, or in the few words of a tick message."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sim.forecast import StepVerdict
from sim.plan import Decision, Option


def decision_json(decision: Decision, narration: str, texts: Sequence[str]) -> dict[str, Any]:
    """A decision with its trace: the `Decision` of the interface; `texts`: one for each of its options."""
    return {
        "tick": decision.tick,
        "planner": decision.planner,
        "move": decision.move,
        "asked": decision.asked,
        "options": options_json(decision, texts),
        "narration": narration,
        "weight": decision.weight,
    }


def brief_decision_json(decision: Decision) -> dict[str, Any]:
    """A decision with only those of its options that were not free.

    `reason` and `causes` are those of the most preferred move: why it was taken, or what kept the
    vehicle from it.
    """
    options, free = decision.options, StepVerdict.FREE
    preferred = options[0]
    return {
        "tick": decision.tick,
        "planner": decision.planner,
        "move": decision.move,
        "reason": preferred.reason,
        "causes": preferred.causes,
        "weight": decision.weight,
        "blocked": [
            {"move": option.move, "reason": option.reason, "causes": option.causes}
            for option in options
            if option.reason is not free
        ],
    }


def options_json(decision: Decision, texts: Sequence[str]) -> list[dict[str, Any]]:
    """Every move with what spoke for or against it."""
    return [_option_json(option, text) for option, text in zip(decision.options, texts, strict=True)]


def _option_json(option: Option, text: str) -> dict[str, Any]:
    return {
        "move": option.move,
        "cell": option.cell,
        "verdict": option.verdict,
        "cost": option.cost,
        "reason": option.reason,
        "causes": option.causes,
        "text": text,
    }
