"""What is told to be in the way is a cause, or what holds the move back without it is told; in few words."""

from __future__ import annotations

import pytest

from service.narration.answer_length import MOST_WORDS
from service.narration.explanation import Explained
from service.narration.sayings import Sayings
from sim.config import Config
from sim.explain import Explanation, why
from sim.plan.rule_based import Leads
from sim.session.timeline import Timeline
from sim.types import Move
from tests.support import sentence_judge as judge
from tests.support.reacting_roads import reacting_runs

Dense = tuple[int, int, float]
"""A seed, the tick of a decision, and the courtesy."""

CROWDED = {"potholes": 25, "vehicles": 90, "pedestrians": 6, "barriers": 8}
HOLED = {"potholes": 40, "vehicles": 60, "pedestrians": 4, "barriers": 0}


def decided(
    seed: int, tick: int, courtesy: float, rows: int = 30, planner: str = "rules", **things: int
) -> Timeline:
    config = Config(
        seed=seed,
        columns=8,
        rows=rows,
        courtesy=courtesy,
        planner=planner,
        **things,  # type: ignore[arg-type]
    )
    timeline = Timeline(config)
    for _ in range(tick + 1):
        timeline.advance()
    return timeline


def told(timeline: Timeline, language: str = "en") -> tuple[Explanation, str]:
    explanation = why(timeline)
    return explanation, Explained(Sayings.load(language)).text(explanation)


@pytest.mark.parametrize(
    ("timeline", "by", "leads", "said"),
    [
        (
            decided(500981574, 13, 0.0, **HOLED),
            "vehicle-48",
            Leads.CLOSED,
            "Even with the cell ahead free, the car 5 m ahead in the second lane to my right would have come "
            "between me and the way on.",
        ),
        (
            decided(2508701601, 25, 0.5, **CROWDED),
            None,
            Leads.NOWHERE,
            "Even free, the cell ahead would have led into a dead end.",
        ),
        (
            decided(1776616311, 16, 0.0, **HOLED),
            "vehicle-38",
            None,
            "Without the car right ahead, the car 5 m ahead on my left would have been in the way.",
        ),
        (
            decided(2724975498, 0, 0.0, **HOLED),
            "vehicle-60",
            None,
            "Otherwise the car 5 m ahead on my right would have kept me from the cell ahead.",
        ),
    ],
)
def test_what_holds_a_move_back_without_its_blocker_is_told(
    timeline: Timeline, by: str | None, leads: Leads | None, said: str
) -> None:
    explanation, text = told(timeline)
    (link, *_) = explanation.chain
    assert (link.by, link.move, link.behind, link.leads) == (by, Move.FORWARD, True, leads)
    assert said in text
    assert [found for _, found in judge.judge_chain(explanation) if found] == []


@pytest.mark.parametrize("language", ["en", "de"])
@pytest.mark.parametrize(
    "timeline",
    [
        decided(1296673381, 12, 0.0, **CROWDED),
        decided(1880890784, 5, 0.5, **HOLED),
        decided(708806329, 21, 0.0, **HOLED),
        decided(3346422519, 10, 0.0, **CROWDED),
        decided(1663778717, 15, 0.0, **HOLED),
        decided(546244442, 5, 0.0, **HOLED),
    ],
)
def test_reasons_of_many_words_are_cut(timeline: Timeline, language: str) -> None:
    explanation, text = told(timeline, language)
    assert 10 < len(text.split()) <= MOST_WORDS
    whole = Explained(Sayings.load(language)).text(explanation, detailed=True)
    assert len(whole.split()) > len(text.split())


def test_on_any_road_the_blocker_is_a_cause_or_the_chain_is_told_in_few_words() -> None:
    chained = 0
    for timeline in reacting_runs(150, seed=5, planners=("rules",)):
        sayings, explained, _ = judge.reading()
        explanation = why(timeline)
        text = explained.text(explanation)
        judged = [
            *judge.judge_left_out(explanation, text, sayings.recorded(text)),
            *judge.judge_chain(explanation),
            *judge.judge_wording(text),
        ]
        assert [found for _, found in judged if found] == []
        chained += bool(judge.CHAINED.search(text))
        assert len(told(timeline, "de")[1].split()) <= MOST_WORDS
    assert chained > 5
