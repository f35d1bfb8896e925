"""The planner `rules`: where it goes on roads small enough to read, what it goes by, how often it arrives."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given

from sim.config import Config
from sim.decide import decide
from sim.forecast import Forecast, predict
from sim.generation import drivable
from sim.perceive import perceive_truth
from sim.plan import Decision
from sim.plan.rule_based import Leads, RulesPlanner, standing
from sim.search.passages import locked_in, ways_past
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import board_of
from tests.support.roads import road, run_on, worlds

MIRRORED = {
    Move.LEFT: Move.RIGHT,
    Move.RIGHT: Move.LEFT,
    Move.FORWARD_LEFT: Move.FORWARD_RIGHT,
    Move.FORWARD_RIGHT: Move.FORWARD_LEFT,
}


def decided(world: World) -> Decision:
    decision = decide(run_on(world, planner="rules"))
    assert decision is not None
    return decision


def driven(seed: int, potholes: int | None) -> SimState | None:
    """The first episode of a seed, to its end; None where the road cannot be driven."""
    config = Config(seed=seed, potholes=potholes, planner="rules")
    state = SimState.start(config)
    if not drivable(state.world, config):
        return None
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state


@pytest.mark.parametrize(
    ("rows", "move"),
    [
        ((".......", ".......", "...A...", "......."), Move.FORWARD),
        # Round what never moves by a diagonal, which gains a row; left only among equals.
        ((".......", "...o...", "...A...", "......."), Move.FORWARD_LEFT),
        ((".......", "..oo...", "...A...", "......."), Move.FORWARD_RIGHT),
        # Toward the nearer gap in a wall.
        ((".......", "o.ooooo", "...A...", "......."), Move.LEFT),
        ((".......", "oooooo.", "...A...", "......."), Move.RIGHT),
        ((".......", ".ooooo.", "...A...", "......."), Move.LEFT),
        ((".......", ".oooo.o", "...A...", "......."), Move.RIGHT),
        ((".......", "o.oo#oo", "..oA...", "......."), Move.STAY),
        # Not into what looks open and is none.
        ((".......", "oooo.oo", "oo...oo", "...A..."), Move.FORWARD),
        (("o.ooooo", "o.oo.oo", "o.oA.oo", "......."), Move.STAY),
        ((".oooooo", ".oo...o", "...A..o", "......."), Move.LEFT),
        # Wait for who passes, or swerve behind; never into the cell a mover comes to.
        ((".....", ".>...", "..A..", "....."), Move.FORWARD_RIGHT),
        ((".....", ".>.oo", "..A..", "....."), Move.STAY),
        # A mover that cannot leave its cell is as good as a wall.
        ((".....", "#>#..", ".A...", "....."), Move.RIGHT),
        ((".....", "><#..", ".A...", "....."), Move.RIGHT),
    ],
)
def test_where_it_goes(rows: tuple[str, ...], move: Move) -> None:
    assert decided(road(*rows)).move is move


def test_a_row_is_not_entered_while_a_mover_comes_between_the_vehicle_and_its_way_on() -> None:
    trap = road("oo.oooo", "...<...", "A......", ".......")
    told = standing(Forecast.of_truth(trap, Config(columns=7, rows=4), 1))
    ahead = told.of(Move.FORWARD)
    assert ahead is not None
    assert (ahead.leads, ahead.columns) == (Leads.CLOSED, 2)
    assert ahead.closer == trap.road.index((2, 1)), "where the car is after the tick"
    assert decided(trap).move is Move.STAY
    assert decided(road("oo.oooo", "...>...", "A......", ".......")).move is Move.FORWARD


def test_walled_in_it_waits() -> None:
    decision = decided(road(".....", "ooooo", ".....", "..A..", "....."))
    assert decision.move is Move.STAY
    assert decision.chosen.dead_end
    assert decision.option(Move.FORWARD).dead_end


def test_a_dead_end_has_no_cost_and_the_order_is_that_of_preference() -> None:
    decision = decided(road(".oooooo", ".oo...o", "...A..o", "......."))
    assert decision.options[0].move is Move.FORWARD
    assert decision.option(Move.FORWARD).dead_end
    costs = [option.cost for option in decision.options if option.cost is not None]
    assert costs == sorted(costs)
    assert decision.chosen.cost == costs[0]


@given(worlds())
def test_a_free_move_is_always_preferred(world: World) -> None:
    decision = decided(world)
    free = [option for option in decision.options if not option.reason.blocks]
    assert not decision.chosen.reason.blocks or not free
    on = [option for option in free if option.cost is not None]
    assert not on or decision.chosen is on[0]


@given(worlds())
def test_movers_of_other_rows_change_nothing_but_for_those_locked_in(world: World) -> None:
    geometry = world.road
    row = world.av // geometry.columns
    near = geometry.row(row) | geometry.row(row - 1)
    locked = locked_in(world.right | world.left, world.fixed, geometry.left_edge, geometry.right_edge)
    far = world.moving & ~near & ~locked
    gone = frozenset(name for cell, name in world.movers.items() if far >> cell & 1)
    assume(gone)
    decision, alone = decided(world), decided(world.without(gone))
    assert (alone.move, [option.move for option in alone.options]) == (
        decision.move,
        [option.move for option in decision.options],
    )


@given(worlds())
def test_a_mirrored_road_is_driven_in_the_mirror_but_for_ties(world: World) -> None:
    decision, other = decided(world), decided(mirrored(world))
    config = Config(columns=world.road.columns, rows=world.road.rows)
    told = standing(Forecast.of_truth(world, config, 1))
    mine, across = told.of(decision.move), told.of(MIRRORED.get(decision.move, decision.move))
    if mine != across and (mine is None or across is None or mine[:2] != across[:2]):
        assert other.move is MIRRORED.get(decision.move, decision.move)


def mirrored(world: World) -> World:
    """The road with left and right changed."""
    columns, rows = world.road.columns, world.road.rows

    def turned(cell: int) -> int:
        return cell - cell % columns + columns - 1 - cell % columns

    def board(cells: int) -> int:
        return board_of([turned(cell) for cell in range(columns * rows) if cells >> cell & 1])

    return replace(
        world,
        avs=tuple(turned(cell) for cell in world.avs),
        right=board(world.left),
        left=board(world.right),
        boards=Boards.in_order([board(cells) for cells in world.boards.by_kind]),
        movers={turned(cell): name for cell, name in world.movers.items()},
        hazards={turned(cell): name for cell, name in world.hazards.items()},
    )


@given(worlds())
def test_ways_lead_from_where_a_slow_search_finds_them(world: World) -> None:
    geometry, fixed = world.road, world.fixed
    ways = ways_past(geometry.columns, geometry.rows, fixed)
    found = {cell for cell in range(geometry.columns) if not fixed >> cell & 1}
    while True:
        more = {
            cell
            for cell in range(geometry.columns * geometry.rows)
            if cell not in found
            and not fixed >> cell & 1
            and any(geometry.moved(cell, move) in found for move in Move if cell >= geometry.columns)
        }
        if not more - found:
            break
        found |= more
    beyond_goal = set(range(geometry.columns))
    assert {
        cell for cell in range(geometry.columns, geometry.columns * geometry.rows) if ways.open >> cell & 1
    } == (found - beyond_goal)
    assert board_of(found) & ~geometry.row(0) == sum(ways.levels) & ~geometry.row(0), "each in one level"


@given(worlds())
def test_who_is_locked_in_never_leaves(world: World) -> None:
    geometry = world.road
    locked = locked_in(world.right | world.left, world.fixed, geometry.left_edge, geometry.right_edge)
    state = run_on(replace(world, avs=(world.av,)), planner="rules", attentive=0.0)
    for _ in range(6):
        if state.world.outcome is not Outcome.RUNNING:
            break
        assert not locked & ~state.world.moving
        state = step(state).state


def test_it_is_asked_the_same_again() -> None:
    planner, config = RulesPlanner(), Config(seed=5, potholes=30, planner="rules")
    state = SimState.start(config)
    decisions = []
    for _ in range(20):
        percept = perceive_truth(state.world, config)
        decisions.append((percept, planner.decide(predict(percept, 1), config)))
        state = step(state).state
    for percept, decision in reversed(decisions):
        assert RulesPlanner().decide(predict(percept, 1), config) == decision


@pytest.mark.parametrize(
    ("potholes", "seeds", "least"), [(None, 200, 0.995), (20, 150, 0.97), (40, 150, 0.93)]
)
def test_how_often_it_arrives(potholes: int | None, seeds: int, least: float) -> None:
    runs = [state for seed in range(seeds) if (state := driven(seed, potholes)) is not None]
    assert sum(state.metrics.successes for state in runs) >= least * len(runs)
    assert not any(state.world.outcome is Outcome.CRASH for state in runs), (
        "movers brake for who stands still"
    )


def test_it_does_not_swing_left_and_right() -> None:
    swings = 0
    for seed in range(200):
        state = driven(seed, None)
        assert state is not None
        signs = "".join("s" if move in (Move.LEFT, Move.RIGHT) else "." for move in state.record.move_list())
        swings += "ssssss" in signs
    assert swings <= 1


def test_the_ways_of_many_roads_driven_in_turn_are_found_once_each() -> None:
    """As thousands of live sessions are: each ticks, then all others, then it again."""
    states = [SimState.start(Config(seed=seed)) for seed in range(200)]
    states = [step(state).state for state in states]
    found = ways_past.cache_info().misses
    for _ in range(3):
        states = [step(state).state for state in states]
    assert ways_past.cache_info().misses == found
