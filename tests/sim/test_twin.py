"""The world against its slow twin: the same state after every tick, on many random roads."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.config import Collision
from sim.transition import step
from sim.types import Kind, Mode, Move, Outcome
from sim.world import World
from tests.support import twin
from tests.support.roads import run_on, worlds
from tools.twin_run import braking, drive_both, random_run


@pytest.mark.parametrize("part", range(4))
def test_same_state_every_tick_on_random_roads(part: int) -> None:
    random = Random(f"twin {part}")
    for _ in range(60):
        drive_both(random_run(random), 420)


@settings(max_examples=150, deadline=None)
@given(
    worlds(),
    st.sampled_from([0.0, 0.5, 1.0]),
    st.sampled_from([0.0, 0.5, 1.0]),
    st.sampled_from(["swept", "cell"]),
)
def test_same_state_on_any_crowded_road(
    world: World, courtesy: float, attentive: float, collision: Collision
) -> None:
    drive_both(run_on(world, courtesy=courtesy, attentive=attentive, collision=collision, seed=3), 30)


@settings(max_examples=150, deadline=None)
@given(worlds(), st.lists(st.sampled_from(list(Move)), min_size=1, max_size=25))
def test_a_persons_moves_lead_to_the_same_states_and_ends(world: World, moves: list[Move]) -> None:
    state = run_on(world).with_ego(mode=Mode.MANUAL, queue=tuple(moves))
    slow = twin.position(world)
    for asked in moves:
        tick = step(state)
        assert tick.decision is not None
        granted = (
            asked if twin.outlook(slow, asked, twin.moved_bodies(slow), braking(state))[2] else Move.STAY
        )
        assert tick.decision.move is granted
        _, slow = twin.step(slow, granted, (), braking(state))
        state = tick.state
        assert twin.position(state.world) == slow
        if slow.outcome is not Outcome.RUNNING:
            return


@pytest.mark.parametrize("part", range(2))
def test_the_result_of_an_episode_stands_still(part: int) -> None:
    random = Random(f"standing {part}")
    for _ in range(15):
        state = random_run(random)
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        ended = twin.position(state.world)
        for later in range(1, state.config.reset_delay_ticks):
            tick = step(state)
            state = tick.state
            assert tick.decision is None
            assert twin.position(state.world).bodies == ended.bodies
            assert twin.position(state.world).av == ended.av
            assert state.world.tick == ended.tick + later
        state = step(state).state
        assert (state.world.episode, state.world.episode_tick) == (2, 0)
        assert state.world.count(Kind.AV) == 1


def test_all_that_is_to_be_compared_happens() -> None:
    """Or the comparisons above would say little."""
    random, counted = Random("what happens"), None
    for _ in range(60):
        more = drive_both(random_run(random), 420)
        counted = more if counted is None else counted + more
    assert counted is not None
    assert all(counted[what] for what in ("success", "crash", "stuck", "repetition", "braked")), counted


def test_rectangles_that_glide() -> None:
    half = (Fraction(1, 2), Fraction(1, 2))
    still = ((0, 0), (0, 0))
    assert twin.together(still, half, ((1, 0), (0, 0)), half)
    assert twin.together(((0, 0), (1, 0)), half, ((1, 0), (0, 0)), half)  # through one another
    assert not twin.together(still, half, ((1, 0), (2, 0)), half)
    assert not twin.together(((0, 0), (1, 0)), half, ((1, 0), (2, 0)), half)  # one behind the other
    # Around a corner they touch at their own corners, at half time, and nowhere else.
    assert not twin.together(((0, 0), (1, 0)), half, ((1, 0), (1, 1)), half)
    bigger = (Fraction(51, 100), Fraction(1, 2))
    assert twin.together(((0, 0), (1, 0)), half, ((1, 0), (1, 1)), bigger)
