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
from sim.forecast import foretell
from sim.kinds import Mode, Move, Outcome
from sim.perceive import perceive
from sim.plan import Decision, planner_named
from sim.rules_version import RULES
from sim.run import Run, advance, decide
from sim.search.costs import BALANCED, weights
from sim.search.reach import reach
from sim.world import World
from tests.sim.roads import road, run_on, worlds
from tests.sim.slow_search import totals
from tests.sim.twin import position

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


def decision(run: Run, planner: str) -> Decision:
    found = planner_named(planner)
    assert found is not None
    return found.decide(foretell(perceive(run.world, run.config), found.horizon(run.config)), run.config)


def costs(taken: Decision) -> dict[Move, float | None]:
    return {move: taken.option(move).cost for move in Move}


@settings(max_examples=60)
@given(worlds(max_columns=6, max_rows=7), PREFERENCES, st.integers(0, 3), st.booleans())
@example(MET, [], 1, False)
@example(MET, [], 1, True)
def test_every_total_is_what_the_whole_table_says(
    world: World, preferences: list[str], buffer: int, braking: bool
) -> None:
    run = run_on(world, preferences=preferences, safety_buffer=buffer, attentive=float(braking))
    found = costs(decision(run, "astar"))
    # No way of more ticks than the dearest total pays for can be cheaper.
    bound = max((cost for cost in found.values() if cost is not None), default=0)
    horizon = max(world.road.rows + 6, int(bound) // weights(run.config).tick)
    assert totals(position(world), weights(run.config), horizon, braking=braking) == found


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
    run = Run.start(config)
    for tick in range(24):
        if run.world.outcome is not Outcome.RUNNING:
            break
        if tick % 4 == 0:
            _agree(run)
        run = advance(run).run


def _agree(run: Run) -> None:
    searched, swept = decision(run, "astar"), decision(run, "dijkstra")
    assert costs(searched) == costs(swept)
    assert searched.move is swept.move
    batch = Batch.of([run])
    assert MOVES[batch.moves("weighted")[0]] is searched.move
    least = searched.chosen.cost
    assert batch.least("weighted")[0] == (-1 if least is None else least)
    quickest = decision(run, "exact")
    assert MOVES[batch.moves("exact")[0]] is quickest.move
    ticks = quickest.chosen.cost
    assert batch.least("exact")[0] == (-1 if ticks is None else ticks)


@settings(max_examples=100)
@given(worlds())
def test_no_step_into_what_is_known_to_be_there_while_another_is_free(world: World) -> None:
    for planner in ("astar", "exact"):
        taken = decision(run_on(world), planner)
        assert taken.chosen.verdict == "free" or all(o.verdict != "free" for o in taken.options)
        assert [o.cost for o in taken.options if o.cost is not None] == sorted(
            o.cost for o in taken.options if o.cost is not None
        )


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "exact"])
@pytest.mark.parametrize("potholes", [0, 40, 70])
def test_the_cost_to_go_falls_by_what_is_paid(planner: str, potholes: int) -> None:
    """So there is no livelock: the next decision's total is this one's less the step taken."""
    run = Run.start(Config(seed=potholes, potholes=potholes, planner=planner))
    before: float | None = None
    while run.world.outcome is Outcome.RUNNING:
        taken = decide(run)
        assert taken is not None
        now = taken.chosen.cost
        assert now is not None
        if before is not None:
            assert now < before
        before, run = now, advance(run).run
    assert run.world.outcome is Outcome.SUCCESS


def test_the_rule_swings_for_ever_where_a_plan_arrives() -> None:
    """The rule's livelock: before a wall it goes back to the left as soon as the left is free."""
    world = road("......", "......", "ooooo.", "oA....")
    stuck = run_on(world)
    visited = []
    while stuck.world.outcome is Outcome.RUNNING:
        stuck = advance(stuck).run
        visited.append(stuck.world.av)
    assert stuck.world.outcome is Outcome.STUCK
    assert len(set(visited)) <= 2
    planned = run_on(world, planner="astar")
    while planned.world.outcome is Outcome.RUNNING:
        planned = advance(planned).run
    assert planned.world.outcome is Outcome.SUCCESS


def test_with_no_way_on_it_lasts_as_long_as_it_can() -> None:
    world = road("....", "oooo", ">...", "..A.")
    for planner in ("astar", "dijkstra", "exact"):
        run = run_on(world, planner=planner)
        taken = decide(run)
        assert taken is not None
        assert all(option.cost is None for option in taken.options)
        while run.world.outcome is Outcome.RUNNING:
            run = advance(run).run
        assert run.world.outcome is Outcome.STUCK


def test_a_person_may_take_a_step_that_leads_nowhere() -> None:
    world = road("....", "o.oo", "..oo", "ooA.")
    run = run_on(world, planner="astar")
    trap = decision(run, "astar").option(Move.RIGHT)
    assert trap.dead_end or trap.cost is not None
    asked = advance(Run(run.config, world, mode=Mode.MANUAL, queue=(Move.RIGHT,)))
    assert asked.decision is not None
    assert asked.decision.move is Move.RIGHT


def driven(world: World, *preferences: str, **parts: object) -> tuple[list[Move], Run]:
    run, moves = run_on(world, planner="astar", preferences=list(preferences), **parts), []
    while run.world.outcome is Outcome.RUNNING:
        tick = advance(run)
        assert tick.decision is not None
        moves.append(tick.decision.move)
        run = tick.run
    return moves, run


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
        run = Run.start(Config(seed=seed, potholes=50, preferences=("fastest",), planner="astar"))
        forecast = foretell(perceive(run.world, run.config), 301)
        least = reach(forecast, 1 << run.world.av, 301).ticks
        while run.world.outcome is Outcome.RUNNING:
            run = advance(run).run
        assert run.world.outcome is not Outcome.SUCCESS or run.world.episode_tick == least


def test_preferences_shift_every_charge_by_their_own() -> None:
    assert weights(Config(safety_buffer=0)) == BALANCED[RULES]
    assert weights(Config(preferences=("cautious",))).buffer == 2
    assert weights(Config(preferences=("avoid_potholes", "smooth_ride"))).fixed > BALANCED[RULES].fixed


def test_most_roads_are_driven_in_about_the_least_ticks() -> None:
    """The batch's planner is astar's own (above), so many roads can be tried."""
    for potholes in (0, 20, 60):
        batch = Batch([Config(seed=s, potholes=potholes) for s in range(1_000)], after="stop")
        least = batch.least("exact")
        batch.run_to_end("weighted")
        totals_ = batch.totals()
        solvable = least > 0
        assert (totals_.successes[solvable] == 1).all()
        assert (totals_.crashes == 0).all()
        assert np.sum(totals_.ticks_to_goal[solvable]) <= 1.02 * np.sum(least[solvable])
