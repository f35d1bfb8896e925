"""What the coming move hangs on is held to taking the thing away and deciding again."""

from __future__ import annotations

import pytest

from sim.actions import Remove, Where
from sim.config import Config
from sim.decide import decide
from sim.explain import QuestionError
from sim.explain.coming_move import coming_decision, coming_move
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.types import Outcome


@pytest.mark.parametrize("planner", ["priority", "rules", "astar"])
@pytest.mark.parametrize("seed", range(5))
def test_without_what_the_move_hangs_on_the_move_told_is_made(seed: int, planner: str) -> None:
    timeline = Timeline(Config(seed=seed, columns=6, rows=14, vehicles=24, potholes=4, planner=planner))
    for _ in range(6):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        found = coming_move(timeline)
        made = decide(timeline.state)
        assert made is not None
        assert found.decision.move is made.move
        for flip in found.flips:
            state = timeline.state
            for name in flip.ids:
                kind = state.world.find(name)
                assert kind is not None
                state = apply(state, Remove(kind=kind.kind.value, count=1, where=Where(id=name))).state
            without = decide(state)
            assert without is not None
            assert without.move is flip.move
            assert flip.move is not made.move
        timeline.advance()


def test_there_is_no_coming_move_once_the_episode_has_ended() -> None:
    timeline = Timeline(Config(seed=1, columns=4, rows=4, vehicles=0))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    with pytest.raises(QuestionError) as refused:
        coming_decision(timeline)
    assert refused.value.code == "nothing_ahead"
