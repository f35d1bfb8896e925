"""A program that reads only explanations predicts decisions, or says that it cannot."""

from __future__ import annotations

import pytest

from service.contract.encode.explanation import explanation_json
from sim.explain import why
from tests.support.intervention_judge import move_after, taking
from tests.support.moments import moments
from tools.explanations_to_read import predicted


@pytest.mark.parametrize(("planner", "least"), [("priority", 1.0), ("rules", 1.0), ("astar", 0.3)])
def test_what_is_read_from_an_explanation_comes_true(planner: str, least: float) -> None:
    told, asked = 0, 0
    for timeline in moments(40, seed=23, planner=planner):
        explanation = why(timeline)
        answer = explanation_json(explanation, [""] * len(explanation.decision.options))
        for thing in list(explanation.moment.world.things())[:3]:
            said = predicted(answer, thing.id)
            seen = move_after(explanation.moment, taking([thing.id], explanation.moment.config))
            asked += 1
            told += said is not None
            assert said in (None, seen), (explanation.moment.config.seed, thing.id)
    assert asked > 80
    assert told >= least * asked
