"""Counts over a session, against counting by hand."""

from __future__ import annotations

from collections import Counter
from math import hypot, isclose

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.config import Config
from sim.metrics import Metrics
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

ENDS = [Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK]


def test_nothing_has_happened_yet() -> None:
    metrics = Metrics()
    assert (metrics.episodes, metrics.steps, metrics.distance_m) == (0, 0, 0.0)
    assert metrics.success_rate is None
    assert metrics.last_episode_ticks is None


@given(st.lists(st.sampled_from(list(Move)), max_size=60), st.floats(0.5, 100))
def test_moves_are_counted_by_kind_and_length(moves: list[Move], cell_m: float) -> None:
    metrics = Metrics()
    for move in moves:
        metrics = metrics.after_move(move, cell_m)
    told = Counter(moves)
    assert metrics.forward == told[Move.FORWARD]
    assert metrics.lateral == told[Move.LEFT] + told[Move.RIGHT]
    assert metrics.diagonal == told[Move.FORWARD_LEFT] + told[Move.FORWARD_RIGHT]
    assert metrics.stay == told[Move.STAY]
    assert metrics.steps == len(moves)
    assert isclose(metrics.distance_m, sum(hypot(*move.offset) * cell_m for move in moves), abs_tol=1e-9)


@given(st.lists(st.tuples(st.sampled_from(ENDS), st.integers(1, 301)), min_size=1, max_size=40))
def test_episodes_are_counted_by_their_end(ends: list[tuple[Outcome, int]]) -> None:
    metrics = Metrics()
    for outcome, ticks in ends:
        metrics = metrics.after_end(outcome, ticks)
    told = Counter(outcome for outcome, _ in ends)
    assert (metrics.successes, metrics.crashes, metrics.stuck) == tuple(told[end] for end in ENDS)
    assert metrics.episodes == len(ends)
    assert metrics.success_rate == told[Outcome.SUCCESS] / len(ends)
    assert metrics.last_episode_ticks == ends[-1][1]


@pytest.mark.parametrize("seed", [1, 2])
def test_a_session_is_counted_as_it_goes(seed: int) -> None:
    # The rule of the source study among drivers who never brake ends in more ways than one.
    config = Config(columns=6, rows=8, seed=seed, potholes=9, cell_m=4.0, planner="priority", attentive=0.0)
    state = SimState.start(config)
    ends: list[Outcome] = []
    moves: list[Move] = []
    for _ in range(400):
        was = state.world.outcome
        tick = step(state)
        state = tick.state
        if tick.decision is not None:
            moves.append(tick.decision.move)
        if was is Outcome.RUNNING and state.world.outcome is not was:
            ends.append(state.world.outcome)
            assert state.metrics.last_episode_ticks == state.world.episode_tick
    assert len(set(ends)) > 1
    assert state.metrics.episodes == len(ends)
    assert state.metrics.successes == ends.count(Outcome.SUCCESS)
    assert state.metrics.steps == len(moves), "no step is counted while a result stands"
    assert isclose(state.metrics.distance_m, sum(4.0 * hypot(*move.offset) for move in moves))
