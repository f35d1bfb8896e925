"""A quiz as JSON values: situations with their solutions, and the words that a page shows with them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service.narration.quiz.result import LEAST, MOST, REVERSED, SATISFACTION, TRUST, VERSION
from service.narration.quiz.situations import PHASES, Situation
from service.narration.sayings import Sayings
from sim.types import MOVES

Json = dict[str, Any]


def quiz_json(planner: str, seed: int, found: Sequence[Situation], sayings: Sayings) -> Json:
    """The quiz; `right` of a situation has its solution."""

    def say(*keys: str, **parts: object) -> str:
        return sayings.say("quiz", *keys, **parts)

    count = sum(each.phase == PHASES[0] for each in found)
    return {
        "version": VERSION,
        "planner": planner,
        "seed": seed,
        "signs": say("signs"),
        "phases": {phase: say("phases", phase, count=count) for phase in PHASES},
        "moves": [{"id": move, "text": say("moves", move)} for move in MOVES],
        "situations": [_situation_json(each) for each in found],
        "scales": {
            name: [{"id": item, "text": say(name, item), "reversed": item in REVERSED} for item in items]
            for name, items in (("satisfaction", SATISFACTION), ("trust", TRUST))
        },
        "scale": {"least": LEAST, "most": MOST},
    }


def _situation_json(situation: Situation) -> Json:
    return {
        "phase": situation.phase,
        "picture": situation.picture,
        "reasons": [{"id": reason.id, "text": reason.text} for reason in situation.reasons],
        "right": {"move": situation.move, "reason": situation.reason},
        "explanation": situation.explanation,
    }
