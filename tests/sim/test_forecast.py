"""The forecast: exact as far as it claims to be, and it names everyone who is in the way."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.commit import commit
from sim.forecast import Forecast, StepVerdict, predict
from sim.perceive import perceive_truth
from sim.types import Move
from sim.world import World
from sim.world.grid import bits
from tests.support import twin
from tests.support.roads import road, run_on, worlds


def expected(world: World, move: Move, horizon: int = 1) -> tuple[StepVerdict, tuple[str, ...]]:
    forecast = Forecast.of_truth(world, run_on(world).config, horizon)
    return forecast.check_step(world.av, world.road.moved(world.av, move))


@settings(max_examples=80, deadline=None)
@given(worlds())
def test_movers_are_foreseen_where_they_will_be(world: World) -> None:
    horizon = 12
    forecast = Forecast.of_truth(world, run_on(world).config, horizon)
    later = world
    for ahead in range(horizon):
        later = commit(later, (Move.STAY,), run_on(world).config)
        slice_ = forecast.slices[ahead]
        assert forecast.slices.movers(ahead) == later.movers
        assert set(bits(slice_.occupied)) == set(later.movers)


@settings(max_examples=60, deadline=None)
@given(worlds())
def test_courtesy_is_known_for_the_coming_tick(world: World) -> None:
    config = run_on(world, courtesy=0.5, seed=8).config
    forecast = Forecast.of_truth(world, config, 1)
    assert forecast.slices.movers(0) == commit(world, (Move.STAY,), config).movers


@settings(max_examples=150, deadline=None)
@given(worlds(), st.booleans())
def test_will_be_free_is_what_the_twin_says(world: World, attentive: bool) -> None:
    """Also of staying, before movers who brake for it."""
    forecast = predict(perceive_truth(world, run_on(world, attentive=float(attentive)).config), 1)
    now = twin.position(world)
    later = twin.moved_bodies(now)
    for move in Move:
        cell = (now.av[0] + move.offset[0], now.av[1] + move.offset[1])
        free = forecast.will_be_free(world.av, world.road.moved(world.av, move))
        assert free is twin.will_be_free(now, later, cell, None if attentive else ())


@pytest.mark.parametrize(
    ("rows", "move", "verdict", "causes"),
    [
        (("...", "...", ".A.", "..."), Move.FORWARD, StepVerdict.FREE, ()),
        (("...", "...", "A..", "..."), Move.LEFT, StepVerdict.OFF_ROAD, ()),
        (("...", "...", "..A", "..."), Move.FORWARD_RIGHT, StepVerdict.OFF_ROAD, ()),
        (("...", ".o.", ".A.", "..."), Move.FORWARD, StepVerdict.POTHOLE, ("pothole-1",)),
        (("...", "..#", ".A.", "..."), Move.FORWARD_RIGHT, StepVerdict.BARRIER, ("barrier-1",)),
        (("...", ">..", ".A.", "..."), Move.FORWARD, StepVerdict.MOVER_ENTERS, ("vehicle-1",)),
        (("...", "o<o", ".A.", "..."), Move.FORWARD, StepVerdict.MOVER_STAYS, ("vehicle-1",)),
        (("...", ".).", ".A.", "..."), Move.FORWARD, StepVerdict.MOVER_STAYS, ("pedestrian-1",)),
        (("...", "...", ">A.", "..."), Move.LEFT, StepVerdict.MOVER_SWAPS, ("vehicle-1",)),
        (("...", "...", ".A<", "..."), Move.RIGHT, StepVerdict.MOVER_SWAPS, ("vehicle-1",)),
        (("...", "...", ">A.", "..."), Move.STAY, StepVerdict.MOVER_ENTERS, ("vehicle-1",)),
        (("...", ".}.", ".A.", "..."), Move.FORWARD, StepVerdict.DISABLED_MOVER, ("pothole-1", "vehicle-1")),
        (("....", "....", ".A<o", "...."), Move.RIGHT, StepVerdict.MOVER_SWAPS, ("vehicle-1",)),
        # A mover that leaves frees its cell for a vehicle that comes from another row.
        ((".....", "..>..", "..A..", "....."), Move.FORWARD, StepVerdict.FREE, ()),
        ((".....", ".....", ".A>..", "....."), Move.RIGHT, StepVerdict.FREE, ()),
    ],
)
def test_what_a_step_meets(
    rows: tuple[str, ...], move: Move, verdict: StepVerdict, causes: tuple[str, ...]
) -> None:
    assert expected(road(*rows), move) == (verdict, causes)


def test_nobody_follows_into_a_cell_that_is_left_in_the_same_tick() -> None:
    """So only the one who leaves it is met on the way into it."""
    world = road("....", "....", "A<<.", "....")
    assert expected(world, Move.RIGHT) == (StepVerdict.MOVER_SWAPS, ("vehicle-1",))


def test_pedestrians_are_foreseen_in_step() -> None:
    world = road("....", ")...", "..A.", "....")
    slices = Forecast.of_truth(world, run_on(world).config, 4).slices
    assert [min(slices.movers(ahead)) - 4 for ahead in range(4)] == [0, 1, 1, 2]


def test_only_free_does_not_block() -> None:
    assert [verdict for verdict in StepVerdict if not verdict.blocks] == [StepVerdict.FREE]
