"""Driving by a simple rule comes to what the same moves come to when a person asks for them in a fork."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

import pytest

from sim.actions import Drive, SetMode
from sim.config import Config
from sim.explain.driving_policy import DEMANDED, FORBIDDEN, Policy, move_of, policy_run
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import FIRST, SimState
from sim.transition import step, transition
from sim.types import Mode, Move, Outcome
from tests.support.chance_judge import DRAWS, FURTHEST

SMALL = Config(
    columns=6, rows=14, potholes=10, vehicles=10, barriers=4, attentive=0.0, courtesy=0.0, repetition=False
)
"""Without an end where a situation repeats, which a person's moves never have."""


def driven(ticks: int, **parts: object) -> Timeline:
    timeline = Timeline(SMALL.with_parts(**parts))
    for _ in range(ticks):
        timeline.advance()
    return timeline


def by_hand(timeline: Timeline, moves: tuple[Move, ...]) -> Timeline:
    """A fork in which a person asks for these moves, one a tick."""
    fork = timeline.copy()
    fork.apply(99, [SetMode(mode=Mode.MANUAL)])
    for sequence, move in enumerate(moves, 100):
        if fork.state.world.outcome is not Outcome.RUNNING:
            break
        fork.apply(sequence, [Drive(move=move)])
        fork.advance()
    return fork


@pytest.mark.parametrize("planner", ["priority", "astar"])
@pytest.mark.parametrize("policy", Policy)
def test_it_comes_to_what_a_person_asking_for_the_moves_comes_to(policy: Policy, planner: str) -> None:
    ends = set()
    for seed in range(15):
        timeline = driven(2, seed=seed, planner=planner)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        before = timeline.state
        found = policy_run(timeline, policy, lane=2 if policy is Policy.TO_LANE else None)
        fork = by_hand(timeline, found.path)
        assert timeline.state is before
        ends.add(found.outcome)
        if found.outcome is not Outcome.CRASH:
            assert fork.state.world.outcome is found.outcome
            assert fork.state.world.tick == timeline.tick + len(found.path)
            continue
        # A person is held back from the step into something, and from no step before it.
        last = timeline.tick + len(found.path) - 1
        held_back = [
            tick
            for tick in range(timeline.tick, fork.tick)
            if (made := fork.decision(tick)) is not None and made.held_back
        ]
        if held_back:
            assert held_back[0] == last
        else:
            assert fork.state.world.cause == found.cause
    assert len(ends) > 1 or policy in DEMANDED


@pytest.mark.parametrize("policy", [Policy.IN_LANE, Policy.NONSTOP])
def test_forbidden_moves_are_never_made_and_others_are_the_planners(policy: Policy) -> None:
    for seed in range(8):
        timeline = driven(1, seed=seed)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        found = policy_run(timeline, policy)
        assert not FORBIDDEN[policy] & set(found.path)
        state = timeline.state
        for move in found.path:
            decision = step(state).decision
            assert decision is not None
            assert move_of(policy, decision) is move
            if decision.move not in FORBIDDEN[policy]:
                assert move is decision.move
            elif decision.option(move).reason.blocks:
                left = [each for each in decision.options if each.move not in FORBIDDEN[policy]]
                assert all(each.reason.blocks for each in left)
            state = transition(state, {FIRST: move}).state
        assert state.world.outcome is found.outcome


def test_pressed_by_hand_it_ends_as_in_a_fork_where_forward_is_asked_for_again_and_again() -> None:
    compared = 0
    for seed in range(15):
        timeline = driven(2, seed=seed)
        found = policy_run(timeline, Policy.STRAIGHT)
        if found.by_hand is None:
            assert found.outcome is not Outcome.CRASH
            continue
        fork = by_hand(timeline, (Move.FORWARD,) * (timeline.state.config.max_ticks + 1))
        assert fork.state.world.outcome is found.by_hand.outcome
        assert fork.state.world.tick == found.by_hand.end
        compared += 1
    assert compared > 3


def test_it_may_begin_at_a_past_tick_and_a_drive_that_is_over_begins_again() -> None:
    timeline = driven(5, seed=3)
    early = policy_run(timeline, Policy.IN_LANE, 2)
    assert early.state.world.tick == 2
    assert early.path == policy_run(driven(2, seed=3), Policy.IN_LANE).path
    with pytest.raises(QuestionError):
        policy_run(timeline, Policy.IN_LANE, 99)
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    again = policy_run(timeline, Policy.IN_LANE)
    assert again.state.world.tick == 0
    assert again.path == policy_run(driven(0, seed=3), Policy.IN_LANE).path


def test_an_end_by_repetition_is_the_end_that_comes_of_going_on() -> None:
    sooner = 0
    for seed in range(15):
        slow, quick = (driven(2, seed=seed, repetition=each) for each in (False, True))
        if slow.state.world.outcome is Outcome.RUNNING:
            ends = [policy_run(each, Policy.IN_LANE) for each in (slow, quick)]
            assert ends[0].outcome is ends[1].outcome
            sooner += len(ends[1].path) < len(ends[0].path)
    assert sooner


@pytest.mark.parametrize("policy", [Policy.STAND, Policy.IN_LANE, Policy.NONSTOP])
def test_chances_are_those_of_drives_with_other_draws(policy: Policy) -> None:
    told = 0
    for seed in range(12):
        timeline = driven(1, seed=seed, vehicles=16, potholes=2, barriers=0, attentive=0.5, courtesy=0.5)
        found = policy_run(timeline, policy)
        if found.chances is None or found.chances.settled:
            continue
        assert found.crashes + found.arrives + found.chances.stuck == pytest.approx(1.0)
        drawn = [ended(timeline.state, policy, draw) for draw in range(DRAWS)]
        share = drawn.count(Outcome.CRASH) / DRAWS
        assert abs(share - found.crashes) < FURTHEST * 0.5 / sqrt(DRAWS)
        told += 1
    assert told > 1


def ended(state: SimState, policy: Policy, draw: int) -> Outcome:
    """How it ends by the rule with other draws after the coming tick, which is drawn already."""
    other = state.config.with_parts(seed=10_000 + draw)
    while state.world.outcome is Outcome.RUNNING:
        decision = step(state).decision
        assert decision is not None
        state = transition(state, {FIRST: move_of(policy, decision)}).state
        state = replace(state, config=other)
    return state.world.outcome
