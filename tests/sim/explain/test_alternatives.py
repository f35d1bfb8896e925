"""What the other move would have led to is what it leads to when a person makes it."""

from __future__ import annotations

import random

import pytest

from sim.explain import why_not
from sim.types import Move, Outcome
from tests.support.intervention_judge import played
from tests.support.moments import moments


@pytest.mark.parametrize(
    ("planner", "count"), [("priority", 250), ("bfs", 30), ("dijkstra", 12), ("astar", 12)]
)
def test_the_stated_end_is_the_end(planner: str, count: int) -> None:
    draw, compared = random.Random(2), 0
    for timeline in moments(count, seed=9, planner=planner):
        state = timeline.at(timeline.tick - 1)
        made = timeline.decision(timeline.tick - 1)
        assert made is not None
        foil = draw.choice([move for move in Move if move is not made.move])
        explanation = why_not(timeline, foil)
        option = explanation.decision.option(foil)
        if option.cell is None:
            assert explanation.stakes is None
            continue
        assert explanation.stakes is not None
        assert explanation.stakes.would is not None
        really = played(state, foil)
        if really is None:
            assert explanation.stakes.would.outcome is Outcome.CRASH
            continue
        compared += 1
        assert (explanation.stakes.would.outcome, explanation.stakes.would.ticks) == really
    assert compared > count / 4
