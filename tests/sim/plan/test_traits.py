"""What the classes of the built-in planners claim of themselves holds, tried on many moments."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.config import Config
from sim.forecast import Forecast, predict
from sim.perceive import Percept, perceive_truth
from sim.plan import Traits, planner_named, traits_of
from sim.plan.conformance import moments
from sim.plan.protocol import UNKNOWN
from sim.planner_names import BUILT_IN
from sim.search.costs import weights
from sim.search.passages import locked_in
from sim.types import Move
from sim.world.grid import Board

WISHES = ("cautious", "avoid_potholes", "smooth_ride", "fastest")


def decided(name: str, percept: Percept, config: Config) -> Move:
    planner = planner_named(name)
    assert planner is not None
    return planner.decide(predict(percept, planner.horizon(config)), config).move


def seen(name: str) -> list[tuple[Percept, Config]]:
    """Small roads only, since searches are asked several times for each."""
    roads = moments(24, 6) if traits_of(name).plans_to_goal else moments(60, 12)
    limit = 120 if traits_of(name).plans_to_goal else 10_000
    states = [state for state in roads if state.config.columns * state.config.rows <= limit]
    assert len(states) > 30
    return [
        (perceive_truth(state.world, config), config)
        for state in states
        for config in [state.config.with_parts(planner=name)]
    ]


def keeping(percept: Percept, kept: Board) -> Percept:
    """What would be seen if the movers in all other cells were gone."""
    return replace(
        percept,
        right=percept.right & kept,
        left=percept.left & kept,
        boards=percept.boards.within(percept.boards.fixed, kept),
        yielding=percept.yielding & kept,
        attentive=percept.attentive & kept,
        movers={cell: name for cell, name in percept.movers.items() if kept >> cell & 1},
    )


def rows_to(percept: Percept, row: int) -> Board:
    """The cells of all rows from the goal to this one."""
    return (1 << max(0, min(row + 1, percept.road.rows)) * percept.road.columns) - 1


@pytest.mark.parametrize("name", [name for name in BUILT_IN if traits_of(name).forward_only])
def test_movers_behind_decide_nothing(name: str) -> None:
    gone = 0
    for percept, config in seen(name):
        reach = weights(config).buffer if traits_of(name).weighs_costs else 0
        row = percept.ego // percept.road.columns
        without = keeping(percept, rows_to(percept, row + reach))
        gone += len(percept.movers) - len(without.movers)
        assert decided(name, without, config) is decided(name, percept, config)
    assert gone


@pytest.mark.parametrize("name", [name for name in BUILT_IN if traits_of(name).local])
def test_a_local_planner_reads_two_rows(name: str) -> None:
    """Besides what never moves: hazards, and the movers that are locked in or held."""
    gone = 0
    for percept, config in seen(name):
        road, row = percept.road, percept.ego // percept.road.columns
        movers, fixed = percept.right | percept.left, percept.potholes | percept.barriers
        still = locked_in(movers, fixed, road.left_edge, road.right_edge) | movers & percept.potholes
        near = rows_to(percept, row) & ~rows_to(percept, row - 2)
        without = keeping(percept, near | still)
        gone += len(percept.movers) - len(without.movers)
        assert decided(name, without, config) is decided(name, percept, config)
    assert gone


@pytest.mark.parametrize("name", BUILT_IN)
def test_preferences_count_where_costs_are_weighed_and_nowhere_else(name: str) -> None:
    changed = 0
    for percept, config in seen(name):
        wished = [config.with_parts(preferences=(wish,), safety_buffer=3) for wish in WISHES]
        moves = {decided(name, percept, each) for each in (config, *wished)}
        changed += len(moves) > 1
    assert bool(changed) is traits_of(name).weighs_costs


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_planner_that_looks_one_tick_ahead_asks_for_no_more(name: str) -> None:
    planner = planner_named(name)
    assert planner is not None
    horizons = {planner.horizon(Config(rows=rows)) for rows in (4, 30)}
    assert (horizons == {1}) is not traits_of(name).plans_to_goal


def test_budgets_are_as_measured() -> None:
    """Snapshots and answers hang on these; bench/ says what decisions take."""
    budgets = {name: (traits_of(name).work, traits_of(name).decisions_per_answer) for name in BUILT_IN}
    quick, search, weighed = (1, 450), (16, 450), (16, 240)
    wanted = {"rules": quick, "priority": quick, "bfs": search, "astar": weighed, "dijkstra": weighed}
    assert budgets.items() >= wanted.items()


def test_of_a_planner_that_is_not_known_nothing_is_supposed() -> None:
    assert traits_of("telepathy") == UNKNOWN == Traits()
    claims = UNKNOWN.local, UNKNOWN.forward_only, UNKNOWN.weighs_costs, UNKNOWN.by_passages, UNKNOWN.quick
    assert not any(claims)
    assert UNKNOWN.plans_to_goal


def test_a_forecast_hands_on_what_it_was_made_from() -> None:
    for state in moments(4, 3):
        percept = perceive_truth(state.world, state.config)
        forecast: Forecast = predict(percept, 2)
        assert forecast.percept is percept
        assert forecast.standing is None or forecast.standing.percept is percept
