"""Planners that weigh costs: four independent ways to the same totals."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sim.actions import Preference
from sim.batch import Batch
from sim.config import Collision, Config
from sim.decide import decide
from sim.forecast import Forecast
from sim.plan import Decision, planner_named
from sim.rules.versions import RULES
from sim.search.compiled_costs import forget_compiled_costs
from sim.search.costs import BALANCED, weights
from sim.search.reachability import reachability
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome
from sim.world import World
from tests.support.roads import road, run_on, worlds
from tests.support.slow_search import totals
from tests.support.twin import position

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")

PREFERENCES = st.lists(st.sampled_from(get_args(Preference)), unique=True, max_size=3)
REACTIONS = st.fixed_dictionaries(
    {
        "courtesy": st.sampled_from([0.0, 0.7]),
        "attentive": st.sampled_from([0.0, 0.5, 1.0]),
        "collision": st.sampled_from(get_args(Collision)),
    }
)
"""Whether movers give way and brake, and what a collision is."""
MOVES = list(Move)
MET = road(".....", ".....", ".....", ">A...")
"""A mover that enters the vehicle's cell, unless it brakes."""


@pytest.fixture(autouse=True)
def _searched() -> None:
    """The planners search, whatever another test has loaded."""
    forget_compiled_costs()


def decision(state: SimState, planner: str) -> Decision:
    found = planner_named(planner)
    assert found is not None
    return found.decide(
        Forecast.of_truth(state.world, state.config, found.horizon(state.config)), state.config
    )


def costs(taken: Decision) -> dict[Move, float | None]:
    return {move: taken.option(move).cost for move in Move}


@settings(max_examples=60)
@given(worlds(max_columns=6, max_rows=7), PREFERENCES, st.integers(0, 3), st.booleans())
@example(MET, [], 1, False)
@example(MET, [], 1, True)
def test_every_total_is_what_the_whole_table_says(
    world: World, preferences: list[str], buffer: int, braking: bool
) -> None:
    state = run_on(world, preferences=preferences, safety_buffer=buffer, attentive=float(braking))
    found = costs(decision(state, "astar"))
    # No way of more ticks than the dearest total pays for can be cheaper.
    bound = max((cost for cost in found.values() if cost is not None), default=0)
    horizon = max(world.road.rows + 6, int(bound) // weights(state.config).tick)
    assert totals(position(world), weights(state.config), horizon, braking=braking) == found


@settings(max_examples=150)
@given(worlds(), PREFERENCES, st.integers(0, 3), REACTIONS)
def test_three_engines_agree(
    world: World, preferences: list[str], buffer: int, reactions: dict[str, object]
) -> None:
    _agree(run_on(world, preferences=preferences, safety_buffer=buffer, **reactions))


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("potholes", [None, 30, 60, 120])
def test_three_engines_agree_along_a_run(seed: int, potholes: int | None) -> None:
    preference = ((), ("cautious",), ("smooth_ride", "avoid_potholes"), ("fastest",))[seed % 4]
    config = Config(
        seed=seed, potholes=potholes, pedestrians=seed % 3, preferences=preference, planner="dijkstra"
    )
    state = SimState.start(config)
    for tick in range(24):
        if state.world.outcome is not Outcome.RUNNING:
            break
        if tick % 4 == 0:
            _agree(state)
        state = step(state).state


def _agree(state: SimState) -> None:
    searched, swept = decision(state, "astar"), decision(state, "dijkstra")
    assert costs(searched) == costs(swept)
    assert searched.move is swept.move
    batch = Batch.of([state])
    assert MOVES[batch.moves("weighted")[0]] is searched.move
    least = searched.chosen.cost
    assert batch.least("weighted")[0] == (-1 if least is None else least)
    quickest = decision(state, "bfs")
    assert MOVES[batch.moves("bfs")[0]] is quickest.move
    ticks = quickest.chosen.cost
    assert batch.least("bfs")[0] == (-1 if ticks is None else ticks)


@settings(max_examples=100)
@given(worlds())
def test_no_step_into_what_is_known_to_be_there_while_another_is_free(world: World) -> None:
    for planner in ("astar", "bfs"):
        taken = decision(run_on(world), planner)
        assert taken.chosen.verdict == "free" or all(o.verdict != "free" for o in taken.options)
        assert [o.cost for o in taken.options if o.cost is not None] == sorted(
            o.cost for o in taken.options if o.cost is not None
        )


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "bfs"])
@pytest.mark.parametrize("potholes", [0, 40, 70])
def test_the_cost_to_go_falls_by_what_is_paid(planner: str, potholes: int) -> None:
    """So there is no livelock: the next decision's total is this one's less the step taken."""
    state = SimState.start(Config(seed=potholes, potholes=potholes, planner=planner))
    before: float | None = None
    while state.world.outcome is Outcome.RUNNING:
        taken = decide(state)
        assert taken is not None
        now = taken.chosen.cost
        assert now is not None
        if before is not None:
            assert now < before
        before, state = now, step(state).state
    assert state.world.outcome is Outcome.SUCCESS


def test_the_rule_swings_for_ever_where_a_plan_arrives() -> None:
    """The rule's livelock: before a wall it goes back to the left as soon as the left is free."""
    world = road("......", "......", "ooooo.", "oA....")
    stuck = run_on(world)
    visited = []
    while stuck.world.outcome is Outcome.RUNNING:
        stuck = step(stuck).state
        visited.append(stuck.world.av)
    assert stuck.world.outcome is Outcome.STUCK
    assert len(set(visited)) <= 2
    planned = run_on(world, planner="astar")
    while planned.world.outcome is Outcome.RUNNING:
        planned = step(planned).state
    assert planned.world.outcome is Outcome.SUCCESS


def test_with_no_way_on_it_lasts_as_long_as_it_can() -> None:
    world = road("....", "oooo", ">...", "..A.")
    for planner in ("astar", "dijkstra", "bfs"):
        state = run_on(world, planner=planner)
        taken = decide(state)
        assert taken is not None
        assert all(option.cost is None for option in taken.options)
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        assert state.world.outcome is Outcome.STUCK


def test_a_person_may_take_a_step_that_leads_nowhere() -> None:
    world = road("....", "o.oo", "..oo", "ooA.")
    state = run_on(world, planner="astar")
    trap = decision(state, "astar").option(Move.RIGHT)
    assert trap.dead_end or trap.cost is not None
    asked = step(SimState(state.config, world).with_ego(mode=Mode.MANUAL, queue=(Move.RIGHT,)))
    assert asked.decision is not None
    assert asked.decision.move is Move.RIGHT


def driven(world: World, *preferences: str, **parts: object) -> tuple[list[Move], SimState]:
    state, moves = run_on(world, planner="astar", preferences=list(preferences), **parts), []
    while state.world.outcome is Outcome.RUNNING:
        tick = step(state)
        assert tick.decision is not None
        moves.append(tick.decision.move)
        state = tick.state
    return moves, state


def test_avoiding_potholes_keeps_a_distance() -> None:
    world = road(".......", ".......", ".......", "..o....", ".......", "...A...")
    near, _ = driven(world)
    far, _ = driven(world, "avoid_potholes")
    assert set(near) == {Move.FORWARD}
    assert Move.FORWARD_RIGHT in far


def test_a_smooth_ride_turns_less() -> None:
    world = road(".......", ".o.....", ".......", "..o....", "..A....")
    turns = {
        preferences: sum(move is not Move.FORWARD for move in driven(world, *preferences)[0])
        for preferences in ((), ("smooth_ride",), ("avoid_potholes",))
    }
    assert turns[("smooth_ride",)] <= turns[()] <= turns[("avoid_potholes",)]


def test_the_fastest_takes_the_least_ticks() -> None:
    for seed in range(12):
        state = SimState.start(Config(seed=seed, potholes=50, preferences=("fastest",), planner="astar"))
        forecast = Forecast.of_truth(state.world, state.config, 301)
        least = reachability(forecast, 1 << state.world.av, 301).ticks
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        assert state.world.outcome is not Outcome.SUCCESS or state.world.episode_tick == least


def test_preferences_shift_every_charge_by_their_own() -> None:
    assert weights(Config(safety_buffer=0)) == BALANCED[RULES]
    assert weights(Config(preferences=("cautious",))).buffer == 2
    assert weights(Config(preferences=("avoid_potholes", "smooth_ride"))).fixed > BALANCED[RULES].fixed


def test_most_roads_are_driven_in_about_the_least_ticks() -> None:
    """The batch's planner is astar's own (above), so many roads can be tried."""
    for potholes in (0, 20, 60):
        batch = Batch([Config(seed=s, potholes=potholes) for s in range(1_000)], after="stop")
        least = batch.least("bfs")
        batch.run_to_end("weighted")
        totals_ = batch.totals()
        solvable = least > 0
        assert (totals_.successes[solvable] == 1).all()
        assert (totals_.crashes == 0).all()
        assert np.sum(totals_.ticks_to_goal[solvable]) <= 1.02 * np.sum(least[solvable])
