"""What a person answered in a quiz: scores before and after, scales, and the file of it."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final

from service.narration.quiz.situations import Phase, Situation
from sim.types import Move

VERSION: Final = 1
"""Of the result's form."""
LEAST: Final = 1
"""The end of the scales that says: I disagree strongly."""
MOST: Final = 5
"""The end that says: I agree strongly."""
SATISFACTION: Final = (
    "understand", "satisfying", "detail", "complete", "usable", "useful", "accuracy", "when_to_trust",
)  # fmt: skip
"""Explanation satisfaction scale of Hoffman et al. (2018), its eight items in our words."""
TRUST: Final = (
    "confident", "predictable", "reliable", "safe", "efficient", "wary", "better_than_novice", "like_using",
)  # fmt: skip
"""Trust scale for explainable AI of Hoffman et al. (2018), its eight items in our words."""
REVERSED: Final = frozenset(("wary",))
"""Items where agreeing means less."""


@dataclass(frozen=True, slots=True)
class Given:
    """One prediction; `reason` is the id of the reason chosen."""

    situation: Situation
    move: Move
    reason: str

    @property
    def move_right(self) -> bool:
        """Whether the move was predicted."""
        return self.move is self.situation.move

    @property
    def reason_right(self) -> bool:
        """Whether the reason was found."""
        return self.reason == self.situation.reason


@dataclass(frozen=True, slots=True)
class Score:
    """Shares of a phase that were right."""

    count: int
    moves: float
    reasons: float
    both: float


@dataclass(frozen=True, slots=True)
class Result:
    """A quiz that is done."""

    planner: str
    seed: int
    language: str
    given: tuple[Given, ...]
    satisfaction: Mapping[str, int]
    trust: Mapping[str, int]


def score(given: Sequence[Given], phase: Phase) -> Score:
    """How much of a phase was right."""
    own = [each for each in given if each.situation.phase == phase]
    count = max(1, len(own))
    return Score(
        count=len(own),
        moves=sum(each.move_right for each in own) / count,
        reasons=sum(each.reason_right for each in own) / count,
        both=sum(each.move_right and each.reason_right for each in own) / count,
    )


def scale_mean(answers: Mapping[str, int]) -> float | None:
    """Mean of a scale, reversed items turned round; None where nothing was answered."""
    turned = [LEAST + MOST - value if name in REVERSED else value for name, value in answers.items()]
    return sum(turned) / len(turned) if turned else None


def as_json(result: Result) -> str:
    """The result as JSON, scores first."""
    before, after = score(result.given, "before"), score(result.given, "after")
    told: dict[str, Any] = {
        "version": VERSION,
        "planner": result.planner,
        "seed": result.seed,
        "language": result.language,
        "scores": {
            "before": asdict(before),
            "after": asdict(after),
            "gain": {"moves": after.moves - before.moves, "reasons": after.reasons - before.reasons},
        },
        "scales": {
            "satisfaction": {"mean": scale_mean(result.satisfaction), "items": dict(result.satisfaction)},
            "trust": {"mean": scale_mean(result.trust), "items": dict(result.trust)},
        },
        "answers": _rows(result),
    }
    return json.dumps(told, indent=2) + "\n"


def as_csv(result: Result) -> str:
    """The result as a table: one line for each prediction and each item of the scales."""
    file = io.StringIO()
    head = ("planner", "seed", "phase", "number", "item", "said", "right_answer", "right")
    table = csv.writer(file, lineterminator="\n")
    table.writerow(head)
    for row in _rows(result):
        for item in ("move", "reason"):
            own = row["phase"], row["number"], item, row[f"said_{item}"], row[item], int(row[f"{item}_right"])
            table.writerow((result.planner, result.seed, *own))
    for scale, answers in (("satisfaction", result.satisfaction), ("trust", result.trust)):
        for item, value in answers.items():
            table.writerow((result.planner, result.seed, scale, "", item, value, "", ""))
    return file.getvalue()


def _rows(result: Result) -> list[dict[str, Any]]:
    return [
        {
            "phase": each.situation.phase,
            "number": number,
            "move": str(each.situation.move),
            "said_move": str(each.move),
            "move_right": each.move_right,
            "reason": each.situation.reason,
            "said_reason": each.reason,
            "reason_right": each.reason_right,
        }
        for number, each in enumerate(result.given, 1)
    ]
