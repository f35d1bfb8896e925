"""Why not: the change stated is the one that does it."""

from __future__ import annotations

import pytest

from sim.explain import QuestionError, why_not
from sim.types import Move
from tests.support.moments import moments, move_after
from tests.support.roads import road, run_on
from tests.support.timelines import timeline_on


def test_every_change_stated_has_the_outcome_stated() -> None:
    flipped = 0
    for timeline in moments(150, seed=3):
        for foil in Move:
            try:
                explanation = why_not(timeline, foil)
            except QuestionError:
                continue
            state = timeline.at(explanation.decision.tick)
            for flip in explanation.counterfactuals:
                assert move_after(state, change=flip.change) is flip.move
                flipped += flip.move is foil
            if explanation.verified.minimal:
                names = [cause.id for cause in explanation.causes]
                for name in names:
                    others = tuple(other for other in names if other != name)
                    assert move_after(state, removed=others) is not foil
    assert flipped > 500


def test_a_blocked_move_is_freed_by_removing_the_blocker() -> None:
    timeline = timeline_on(run_on(road("........", "........", "..oo....", "..oA....")))
    explanation = why_not(timeline, Move.LEFT)
    (flip,) = explanation.counterfactuals
    assert explanation.decision.move is Move.RIGHT
    assert (flip.removed, flip.move) == (("pothole-3",), Move.LEFT)
    assert explanation.verified.minimal


def test_a_free_move_needs_the_preferred_ones_blocked() -> None:
    timeline = timeline_on(run_on(road("........", "........", "........", "...A....")))
    (flip,) = why_not(timeline, Move.RIGHT).counterfactuals
    assert flip.added == (("barrier", (3, 2)), ("barrier", (2, 3)))
    assert flip.move is Move.RIGHT


def test_no_change_of_things_makes_road_beyond_the_edge() -> None:
    timeline = timeline_on(run_on(road("........", "........", "........", "A.......")))
    explanation = why_not(timeline, Move.LEFT)
    assert explanation.counterfactuals == ()
    assert explanation.decision.option(Move.LEFT).cell is None


def test_a_move_that_was_made_is_not_asked_why_not() -> None:
    timeline = timeline_on(run_on(road("........", "........", "........", "...A....")))
    with pytest.raises(QuestionError) as caught:
        why_not(timeline, Move.FORWARD)
    assert caught.value.code == "was_made"
