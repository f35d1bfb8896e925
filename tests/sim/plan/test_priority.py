"""The rule planner: its order, and its trace on roads small enough to read."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from sim import planner_names
from sim.config import Config
from sim.decide import decide
from sim.forecast import Forecast, StepVerdict
from sim.plan import Decision, planner_named, register
from sim.plan.priority import PriorityPlanner, options_in_order
from sim.state import SimState
from sim.types import MOVES, Move, kind_of
from sim.world import World
from tests.support.roads import road, run_on, worlds


def decided(world: World) -> Decision:
    decision = decide(run_on(world))
    assert decision is not None
    return decision


@pytest.mark.parametrize(
    ("rows", "move"),
    [
        ((".....", ".....", "..A..", "....."), Move.FORWARD),
        ((".....", "..o..", "..A..", "....."), Move.LEFT),
        ((".....", "..o..", ".oA..", "....."), Move.RIGHT),
        ((".....", "..o..", ".oAo.", "....."), Move.FORWARD_LEFT),
        ((".....", ".oo..", ".oAo.", "....."), Move.FORWARD_RIGHT),
        ((".....", ".ooo.", ".oAo.", "....."), Move.STAY),
        # The edge is as good as a wall.
        ((".....", "o....", "A....", "....."), Move.RIGHT),
        ((".....", "....o", "...oA", "....."), Move.FORWARD_LEFT),
        # Into the cell that a mover leaves; not into the one it comes to.
        ((".....", "..>..", "..A..", "....."), Move.FORWARD),
        ((".....", ".>...", "..A..", "....."), Move.LEFT),
        # Never through a mover that comes the other way.
        ((".....", "..o..", ".>A..", "....."), Move.RIGHT),
        # A mover comes, and there is nowhere to go: stay is the last resort, free or not.
        ((".....", ".ooo.", ".>Ao.", "....."), Move.STAY),
    ],
)
def test_the_first_move_that_will_be_free(rows: tuple[str, ...], move: Move) -> None:
    assert decided(road(*rows)).move is move


def test_the_order() -> None:
    assert MOVES == (
        Move.FORWARD,
        Move.LEFT,
        Move.RIGHT,
        Move.FORWARD_LEFT,
        Move.FORWARD_RIGHT,
        Move.STAY,
    )


def test_every_move_has_its_reason() -> None:
    world = road(
        ".....",
        "}o...",
        ".A<#.",
        ".....",
    )
    told = [
        (option.move, option.cell, option.verdict, option.reason, option.cost, option.causes)
        for option in decided(world).options
    ]
    assert told == [
        (Move.FORWARD, (1, 1), "blocked", StepVerdict.POTHOLE, None, ("pothole-2",)),
        (Move.LEFT, (0, 2), "free", StepVerdict.FREE, 1.0, ()),
        (Move.RIGHT, (2, 2), "blocked", StepVerdict.MOVER_SWAPS, None, ("vehicle-2",)),
        (Move.FORWARD_LEFT, (0, 1), "blocked", StepVerdict.DISABLED_MOVER, None, ("pothole-1", "vehicle-1")),
        (Move.FORWARD_RIGHT, (2, 1), "blocked", StepVerdict.MOVER_CROSSES, None, ("vehicle-2",)),
        (Move.STAY, (1, 2), "blocked", StepVerdict.MOVER_ENTERS, None, ("vehicle-2",)),
    ]


def test_off_the_road_is_a_verdict_of_its_own() -> None:
    option = decided(road("...", "...", "A..", "...")).option(Move.LEFT)
    assert (option.verdict, option.reason, option.cell, option.cost) == (
        "off_road",
        StepVerdict.OFF_ROAD,
        None,
        None,
    )


@settings(max_examples=150, deadline=None)
@given(worlds())
def test_the_decision_follows_from_its_own_trace(world: World) -> None:
    decision = decided(world)
    assert (decision.tick, decision.av, decision.planner) == (world.tick, "av-1", "priority")
    assert tuple(option.move for option in decision.options) == MOVES
    free = [option for option in decision.options if option.verdict == "free"]
    assert decision.chosen is (free[0] if free else decision.option(Move.STAY))
    for option in decision.options:
        assert (option.cost is None) is (option.verdict != "free")
        assert bool(option.causes) is (option.verdict == "blocked")
        assert all(world.find(name) for name in option.causes)
    costs = [option.cost for option in free if option.cost is not None]
    assert costs == sorted(costs)


@settings(max_examples=150, deadline=None)
@given(worlds())
def test_what_is_named_as_the_cause_is_the_cause(world: World) -> None:
    """A blocked move is free once those named are gone and nobody else comes in their stead."""
    for option in decided(world).options:
        if option.verdict != "blocked":
            continue
        alone = decided(world.keeping(option.causes)).option(option.move)
        without = decided(world.without(option.causes)).option(option.move)
        if option.reason in (StepVerdict.POTHOLE, StepVerdict.BARRIER, StepVerdict.DISABLED_MOVER):
            fixed = {name for name in option.causes if kind_of(name).fixed}
            assert fixed <= set(alone.causes)
        assert set(without.causes).isdisjoint(option.causes)


def test_one_name_one_planner() -> None:
    assert isinstance(planner_named("priority"), PriorityPlanner)
    assert planner_named("telepathy") is None
    with pytest.raises(ValueError, match="already a planner called 'priority'"):
        register(PriorityPlanner())


def test_a_planner_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_names, "known", lambda _: True)  # as one that is no longer installed was
    decision = decide(SimState.start(Config(planner="gone")))
    assert decision is not None
    assert (decision.move, decision.fault) == (Move.STAY, "is not installed")


@given(worlds())
def test_all_moves_at_once_meet_what_each_alone_does(world: World) -> None:
    forecast = Forecast.of_truth(world, run_on(world).config, 1)
    for rank, option in enumerate(options_in_order(forecast)):
        end = world.road.moved(world.av, option.move)
        assert (option.reason, option.causes) == forecast.check_step(world.av, end)
        assert option.cell == (None if end is None else world.road.cell(end))
        assert option.cost == (None if option.reason.blocks else float(rank))
