"""What is seen is the percept's, and what is met straight on is what driving straight on meets."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given

from sim.commit import commit
from sim.config import Config
from sim.explain.scene import Scene, describe_percept
from sim.judge import collisions
from sim.perceive import perceive_truth
from sim.state import SimState
from sim.types import Kind, Move
from sim.world import World
from sim.world.boards import NO_BOARDS, Boards
from tests.support.roads import road, run_on, worlds


def scene(state: SimState) -> Scene:
    return describe_percept(perceive_truth(state.world, state.config), state.config)


def met_by_driving(state: SimState, reach: int) -> dict[str, int]:
    """In how many ticks each thing is hit by a vehicle that drives on through everything."""
    met: dict[str, int] = {}
    world = state.world
    for tick in range(1, reach + 1):
        after = commit(world, (Move.FORWARD,), state.config)
        for cause in collisions(world, after, state.config.ego_dynamics(world.road)):
            for name in cause.ids:
                met.setdefault(name, tick)
        world = after
    return met


@given(worlds())
def test_what_is_met_straight_on_is_what_driving_straight_on_hits(world: World) -> None:
    state = run_on(world)
    seen = scene(state)
    assert seen.reach == min(world.road.cell(world.av)[1], state.config.visible_rows)
    assert {thing.id: thing.ticks for thing in seen.threats} == met_by_driving(state, seen.reach)


@given(worlds())
def test_everything_is_seen_once_where_it_is(world: World) -> None:
    column, row = world.road.cell(world.av)
    seen = scene(run_on(world)).seen
    expected = {thing.id: (thing.kind, thing.cell, thing.heading, thing.disabled) for thing in world.things()}
    assert {thing.id: (thing.kind, thing.cell, thing.heading, thing.held) for thing in seen} == expected
    assert len(seen) == len(expected)
    for thing in seen:
        assert (column + thing.lanes, row - thing.rows) == thing.cell
        assert thing.likelihood == 1.0


def test_what_is_met_comes_first_then_what_is_near() -> None:
    state = run_on(road("...o....", "...o....", "........", "o......o", "..oA...."))
    assert [(thing.cell, thing.ticks) for thing in scene(state).seen] == [
        ((3, 1), 3),
        ((3, 0), 4),
        ((2, 4), None),
        ((0, 3), None),
        ((7, 3), None),
    ]


def test_a_mover_is_met_where_it_will_be() -> None:
    state = run_on(road("........", "........", ".>......", "........", "...A...."))
    (car,) = scene(state).seen
    assert (car.ticks, car.lanes, car.rows, car.heading) == (2, -2, 2, "right")


def test_no_further_than_the_next_rows_is_looked_for_what_would_be_met() -> None:
    rows = ["...o...."] + ["........"] * 10 + ["...A...."]
    state = run_on(road(*rows))
    assert [thing.ticks for thing in scene(state).seen] == [None]
    assert [thing.ticks for thing in scene(replace(state, config=Config(rows=12, visible_rows=11))).seen] == [
        11
    ]


def test_what_the_sensors_miss_is_not_seen_and_what_they_imagine_is() -> None:
    state = run_on(road("........", "...o....", "........", "...A...."))
    percept = perceive_truth(state.world, state.config)
    blind = replace(percept, boards=NO_BOARDS, hazards={})
    assert describe_percept(blind, state.config).seen == ()
    index = state.world.road.index((3, 2))
    ghost = replace(blind, boards=Boards.of({Kind.BARRIER: 1 << index}), hazards={index: "barrier-9"})
    (thing,) = describe_percept(ghost, state.config, {"barrier-9": 0.7}).seen
    assert (thing.id, thing.kind, thing.likelihood, thing.ticks) == ("barrier-9", Kind.BARRIER, 0.7, 1)


@pytest.mark.parametrize("kind", [Kind.POTHOLE, Kind.VEHICLE])
def test_one_kind_is_told_from_the_others(kind: Kind) -> None:
    seen = scene(run_on(road("..o.....", ".>......", "....)...", "...A....")))
    assert {thing.kind for thing in seen.of(kind)} == {kind}
    assert len(seen.of(None)) == 3
