"""Several moves in order come to what making them one by one, and driving on after them, comes to."""

from __future__ import annotations

from itertools import product

import pytest

from sim.config import Config
from sim.explain.alternatives import after_move
from sim.explain.moves_in_order import moves_in_order
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Move, Outcome

CERTAIN = Config(seed=5, vehicles=6, pedestrians=3, barriers=4, potholes=4)


def driven(ticks: int) -> Timeline:
    timeline = Timeline(CERTAIN)
    for _ in range(ticks):
        timeline.advance()
    return timeline


def test_the_moves_come_to_what_making_them_one_by_one_comes_to() -> None:
    timeline = driven(3)
    hits = frees = off = 0
    for moves in product((Move.LEFT, Move.FORWARD, Move.STAY), repeat=3):
        found = moves_in_order(timeline, moves)
        state, left, made = timeline.state, False, 0
        for move in moves:
            made += 1
            if state.config.ego_dynamics(state.world.road).target(state.world.av, move) is None:
                left = True
                break
            state = after_move(state, move)
            if state.world.outcome is not Outcome.RUNNING:
                break
        if left:
            assert found.off_road
            assert found.made == made - 1
            off += 1
        elif state.world.outcome is Outcome.CRASH:
            assert found.hit == state.world.cause
            assert (found.made, found.then) == (made, None)
            hits += 1
        else:
            while state.world.outcome is Outcome.RUNNING:
                state = step(state).state
            assert found.then is not None
            assert found.then.story.digest == state.world.digest()
            assert found.then.story.end == state.world.tick
            frees += 1
    assert hits + off
    assert frees


def test_they_may_begin_at_a_past_tick() -> None:
    timeline = driven(6)
    found = moves_in_order(timeline, (Move.STAY, Move.FORWARD), 2)
    assert found.state.world.tick == 2
    assert found == moves_in_order(driven(2), (Move.STAY, Move.FORWARD), 2)
    with pytest.raises(QuestionError):
        moves_in_order(timeline, (Move.STAY,), 99)
