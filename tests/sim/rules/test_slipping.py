"""On snow a step to the side may be lost, by chance that a replay repeats and that nobody foresees."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from sim.batch import Batch
from sim.config import Config, ConfigError
from sim.events import EventType
from sim.explain.confidence import Method, confidence
from sim.oracle.certificate import certify
from sim.oracle.lower_bounds import can_arrive, least_ticks
from sim.oracle.other_egos import UndeterminedError
from sim.rules.compiled import drives_in_batch
from sim.rules.slipping import STRAIGHT, moves_made
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world, step, transition
from sim.types import MOVES, Move, Outcome
from tests.support.roads import road, run_on

SNOW: dict[str, Any] = {"weather": "snow", "slip_probability": 0.3}


def drive(config: Config, ticks: int = 60) -> list[SimState]:
    states = [SimState.start(config)]
    while len(states) < ticks and states[-1].world.outcome is Outcome.RUNNING:
        states.append(step(states[-1]).state)
    return states


def test_without_snow_nothing_slips() -> None:
    for weather in ("clear", "rain", "fog"):
        dry = Config(seed=4, weather=weather, slip_probability=1.0)  # type: ignore[arg-type]
        assert dry.slips == 0.0
        digests = [state.world.digest() for state in drive(dry)]
        assert digests == [state.world.digest() for state in drive(Config(seed=4))]
    assert (
        drive(Config(seed=4, weather="snow"))[-1].world.digest() == drive(Config(seed=4))[-1].world.digest()
    )


def test_a_slipped_move_is_made_without_its_step_aside() -> None:
    state = run_on(road(*["....."] * 3, "..A..", "....."), weather="snow", slip_probability=1.0)
    for move in MOVES:
        after = next_world(state.world, (move,), state.config)
        straight = next_world(state.world, (STRAIGHT.get(move, move),), Config(columns=5, rows=5))
        assert after.av == straight.av
    moved = transition(state, {"av-1": Move.LEFT}).state
    assert (moved.metrics.lateral, moved.metrics.stay) == (0, 1)


def test_as_many_slip_as_are_said_to() -> None:
    config = Config(**SNOW)
    world = SimState.start(config).world
    tried = (Move.FORWARD_LEFT,)
    lost = sum(
        moves_made(replace(world, tick=tick, episode_start=0), tried, config) != tried
        for tick in range(4_000)
    )
    assert abs(lost / 4_000 - 0.3) < 0.03


def test_a_replay_slips_again_and_says_so() -> None:
    slipped = []
    for seed in range(12):
        config = Config(seed=seed, potholes=25, **SNOW)
        first, again = drive(config), drive(config)
        assert [state.world.digest() for state in first] == [state.world.digest() for state in again]
        for state in first[:-1]:
            done = step(state)
            told = [event for event in done.events if event.type is EventType.SLIPPED]
            assert done.decision is not None
            made = moves_made(state.world, (done.decision.move,), config)[0]
            assert [event.move for event in told] == (
                [] if made is done.decision.move else [done.decision.move]
            )
            slipped += told
    assert slipped


def test_nothing_is_proved_of_a_road_on_which_moves_slip() -> None:
    state = SimState.start(Config(seed=2, **SNOW))
    assert not state.config.certain
    for claim in (least_ticks, can_arrive, certify):
        with pytest.raises(UndeterminedError, match="slips"):
            claim(state)


def test_the_chance_of_an_end_counts_both_ways_of_a_move_that_may_slip() -> None:
    """Straight on, then a diagonal through the gap: of one that slips, the step into the barrier is left."""
    walled = road(".....", "##.##", ".....", ".A...", ".....")
    state = run_on(walled, weather="snow", slip_probability=0.25, planner="bfs")
    found = confidence(Timeline(state.config, state))
    assert found.method is Method.ALL_FUTURES
    assert found.chance
    assert found.arrives == pytest.approx(0.75)
    assert found.crashes == pytest.approx(0.25)


def test_a_batch_refuses_what_slips() -> None:
    config = Config(**SNOW)
    with pytest.raises(ValueError, match="slip"):
        Batch([config])
    with pytest.raises(ValueError, match="slip"):
        Batch.of_seeds(config, np.arange(3))
    assert not drives_in_batch(config, "priority")
    assert drives_in_batch(Config(weather="snow"), "priority")


def test_a_probability_is_one() -> None:
    with pytest.raises(ConfigError):
        Config(slip_probability=1.1)
