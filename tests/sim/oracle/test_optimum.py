"""Optimum, certificates and regret against exhaustive search over the twin."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.config import Config
from sim.generation import GenerationError, generate
from sim.oracle import Blocked, Drivable, certify, least_cost, least_ticks, regret, regrets
from sim.oracle.certificate import arrives
from sim.session.timeline import Timeline
from sim.state import SimState, next_episode
from sim.transition import step
from sim.types import Move, Outcome
from sim.world import World
from tests.support import slow_search
from tests.support.roads import road, run_on, worlds
from tests.support.twin import position
from tests.support.twin import step as twin_step


@settings(max_examples=150)
@given(worlds(max_columns=6, max_rows=7))
def test_least_ticks_are_those_of_an_exhaustive_search(world: World) -> None:
    assert least_ticks(run_on(world)) == slow_search.least_ticks(position(world))


@settings(max_examples=30)
@given(worlds(max_columns=5, max_rows=6))
def test_certificates_hold(world: World) -> None:
    state = run_on(world)
    found = certify(state)
    if isinstance(found, Drivable):
        assert found.ticks == slow_search.least_ticks(position(world))
        assert arrives(state, found.plan)
        return
    assert isinstance(found, Blocked)
    assert slow_search.least_ticks(position(world)) is None
    if found.ids:
        assert slow_search.least_ticks(position(world.without(found.ids))) is not None
    size = len(found.ids) if found.minimal else 0
    smaller = [part for k in range(size) for part in combinations(found.ids, k)]
    smaller += [tuple(other for other in found.ids if other != name) for name in found.ids]
    for part in smaller:
        assert slow_search.least_ticks(position(world.without(part))) is None


@pytest.mark.parametrize(
    ("seed", "potholes"), [(0, 120), (1, 120), (5, 120), (7, 120), (2, 60), (4, 60), (6, 90)]
)
def test_crowded_default_roads_are_certified(seed: int, potholes: int) -> None:
    """Where nobody brakes, by the slow search; where all brake, the twin drives the ways that are found."""
    state = SimState.start(Config(seed=seed, potholes=potholes, attentive=0.0))
    found = certify(state)
    assert isinstance(found, Blocked) is (slow_search.least_ticks(position(state.world)) is None)
    if isinstance(found, Blocked):
        assert slow_search.least_ticks(position(state.world.without(found.ids))) is not None
    braking = replace(state, config=state.config.with_parts(attentive=1.0))
    proof = certify(braking)
    if isinstance(proof, Blocked):
        assert isinstance(found, Blocked), "what needs no braking is there with braking as well"
        braking = replace(braking, world=state.world.without(proof.ids))
        proof = certify(braking)
    assert isinstance(proof, Drivable)
    now = position(braking.world)
    for move in proof.plan:
        assert now.outcome is Outcome.RUNNING
        _, now = twin_step(now, move)
    assert now.outcome is Outcome.SUCCESS


def test_a_wall_names_one_of_its_stones() -> None:
    found = certify(run_on(road("....", "####", "....", "..A.")))
    assert isinstance(found, Blocked)
    assert len(found.ids) == 1
    assert found.minimal


def test_too_late_is_nobodys_fault() -> None:
    world = replace(road("....", "....", "....", "..A."), tick=40)
    assert certify(run_on(world)) == Blocked((), True)


def test_after_the_end_there_is_nothing_to_certify() -> None:
    world = replace(road("..A.", "....", "....", "...."), outcome=Outcome.SUCCESS, ended=0)
    assert least_ticks(run_on(world)) == 0
    with pytest.raises(ValueError, match="ended"):
        certify(run_on(world))


def test_a_wall_is_proved_to_be_one_with_courtesy_as_well() -> None:
    found = certify(run_on(road("....", "####", "....", "..A."), courtesy=0.5))
    assert isinstance(found, Blocked)
    assert len(found.ids) == 1


@settings(max_examples=60)
@given(worlds(max_columns=6, max_rows=6), st.sampled_from(list(Move)), st.sampled_from([0.0, 0.5, 1.0]))
def test_regret_is_never_negative(world: World, move: Move, attentive: float) -> None:
    if world.road.moved(world.av, move) is None:
        return
    state = run_on(world, attentive=attentive)
    found = regret(state, move)
    if least_ticks(state) is None:
        assert found.ticks is None
        assert not found.lost
    elif found.lost:
        assert found.ticks is None
    else:
        assert found.ticks is not None
        assert found.cost is not None
        assert min(found.ticks, found.cost) >= 0


@pytest.mark.parametrize("planner", ["rules", "priority", "astar", "bfs"])
def test_regrets_add_up_to_what_was_lost(planner: str) -> None:
    timeline = Timeline(Config(seed=4, potholes=25, planner=planner))
    least, cost = least_ticks(timeline.state), least_cost(timeline.state)
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    assert timeline.state.world.outcome is Outcome.SUCCESS
    found = [each for _, each in regrets(timeline, 0, timeline.tick)]
    assert least is not None
    assert sum(each.ticks or 0 for each in found) == timeline.tick - least
    assert cost is not None
    if planner == "astar":
        assert all(each.cost == 0 for each in found)
    if planner == "bfs":
        assert all(each.ticks == 0 for each in found)


def test_roads_that_must_be_drivable_are() -> None:
    drawn_again = 0
    for seed in range(12):
        config = Config(seed=seed, potholes=70, solvable=True)
        world = generate(config, 1)
        assert isinstance(certify(SimState(config, world)), Drivable)
        plain = generate(config.with_parts(solvable=False), 1)
        if least_ticks(SimState(config, plain)) is not None:
            assert world == plain
        else:
            drawn_again += 1
    assert 0 < drawn_again < 12


def test_what_cannot_be_found_is_said() -> None:
    config = Config(columns=8, rows=6, barriers=31, vehicles=0, potholes=0, solvable=True)
    with pytest.raises(GenerationError, match="no drivable road"):
        generate(config, 1)


def test_where_no_next_road_is_found_the_present_one_is_kept() -> None:
    config = Config(columns=8, rows=6, barriers=31, vehicles=0, potholes=0, solvable=True)
    state = SimState(config, generate(config.with_parts(barriers=0), 1))
    impossible = replace(state, config=config)
    with pytest.raises(GenerationError):
        next_episode(impossible)  # not even the present one can be drawn again here
    kept = SimState.start(Config(seed=1, solvable=True))
    assert next_episode(kept)[0].world.episode == 2
    assert step(kept).state.world.tick == 1
