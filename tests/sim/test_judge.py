"""The judge is fed one bad tick per clause; it lists every defect and knows no planner."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.judge import collisions, outcome
from sim.rules.dynamics_registry import dynamics_on
from sim.types import Kind, Outcome
from sim.world import Cause, World
from tests.support.roads import road


def av_at(world: World, *cells: tuple[int, int]) -> World:
    """The world with its vehicles elsewhere, on top of things if need be."""
    return replace(world, avs=tuple(world.road.index(cell) for cell in cells))


def mover_at(world: World, name: str, cell: tuple[int, int]) -> World:
    """The world with one mover elsewhere."""
    rest = {index: other for index, other in world.movers.items() if other != name}
    return replace(world, movers={**rest, world.road.index(cell): name})


ROAD = road(
    "......",
    ".o#...",
    "..A>..",
    "..(...",
    "......",
)
OPEN = ROAD.without({"pothole-1", "barrier-1"})
"""The same with movers alone."""


@pytest.mark.parametrize(
    ("cell", "cause"),
    [
        ((1, 1), Cause("hit", Kind.POTHOLE, ("pothole-1",), (1, 1))),
        ((2, 1), Cause("hit", Kind.BARRIER, ("barrier-1",), (2, 1))),
        ((3, 2), Cause("hit", Kind.VEHICLE, ("vehicle-1",), (3, 2))),
        ((2, 3), Cause("hit", Kind.PEDESTRIAN, ("pedestrian-1",), (2, 3))),
    ],
)
def test_two_bodies_in_one_cell(cell: tuple[int, int], cause: Cause) -> None:
    after = av_at(ROAD, cell)
    assert collisions(ROAD, after, dynamics_on(ROAD.road)) == (cause,)
    assert outcome(after, (cause,), 50) is Outcome.CRASH


def test_a_mover_that_comes_to_a_waiting_vehicle() -> None:
    after = mover_at(ROAD, "vehicle-1", (2, 2))
    assert collisions(ROAD, after, dynamics_on(ROAD.road)) == (
        Cause("hit", Kind.VEHICLE, ("vehicle-1",), (2, 2)),
    )


def test_passing_through_a_mover() -> None:
    after = av_at(mover_at(ROAD, "vehicle-1", (2, 2)), (3, 2))
    assert collisions(ROAD, after, dynamics_on(ROAD.road)) == (
        Cause("swap", Kind.VEHICLE, ("vehicle-1",), (3, 2)),
    )


def test_following_a_mover_or_leaving_straight_before_it_is_no_collision() -> None:
    follows = av_at(mover_at(OPEN, "vehicle-1", (4, 2)), (3, 2))
    assert collisions(OPEN, follows, dynamics_on(OPEN.road)) == ()
    leaves = av_at(mover_at(OPEN, "vehicle-1", (2, 2)), (2, 1))
    assert collisions(OPEN, leaves, dynamics_on(OPEN.road)) == ()


@pytest.mark.parametrize(("end", "met"), [((3, 1), True), ((1, 1), False)])
def test_a_diagonal_is_met_by_a_mover_that_comes_from_that_side_into_the_cell_it_leaves(
    end: tuple[int, int], met: bool
) -> None:
    after = av_at(mover_at(OPEN, "vehicle-1", (2, 2)), end)
    cause = Cause("cross", Kind.VEHICLE, ("vehicle-1",), (2, 2))
    assert collisions(OPEN, after, dynamics_on(OPEN.road)) == ((cause,) if met else ())
    assert collisions(OPEN, after, dynamics_on(OPEN.road, bodies=False)) == ()


def test_two_autonomous_vehicles_in_one_cell_or_swapped() -> None:
    both = av_at(ROAD, (4, 3), (5, 3))
    met = Cause("hit", Kind.AV, ("av-1", "av-2"), (5, 3), "av-2")
    passed = Cause("swap", Kind.AV, ("av-1", "av-2"), (4, 3), "av-2")
    assert collisions(both, av_at(both, (5, 3), (5, 3)), dynamics_on(both.road)) == (met,)
    assert collisions(both, av_at(both, (5, 3), (4, 3)), dynamics_on(both.road)) == (passed,)
    freed = Cause("cross", Kind.AV, ("av-1", "av-2"), (4, 3), "av-2")
    assert collisions(both, av_at(both, (5, 2), (4, 3)), dynamics_on(both.road)) == (freed,)
    assert collisions(both, av_at(both, (5, 2), (4, 3)), dynamics_on(both.road, bodies=False)) == ()
    assert collisions(both, both, dynamics_on(both.road)) == ()


def test_all_defects_are_listed() -> None:
    before = av_at(ROAD, (2, 2), (4, 2), (0, 4))
    after = av_at(mover_at(ROAD, "vehicle-1", (2, 2)), (3, 2), (3, 2), (1, 1))
    assert collisions(before, after, dynamics_on(before.road)) == (
        Cause("swap", Kind.VEHICLE, ("vehicle-1",), (3, 2)),
        Cause("hit", Kind.AV, ("av-1", "av-2"), (3, 2), ego="av-2"),
        Cause("hit", Kind.POTHOLE, ("pothole-1",), (1, 1), ego="av-3"),
    )


def test_a_mover_held_by_the_pothole_is_listed_beside_it() -> None:
    before = road("....", ".}..", ".A..", "....")
    after = av_at(before, (1, 1))
    assert [cause.ids for cause in collisions(before, after, dynamics_on(before.road))] == [
        ("pothole-1",),
        ("vehicle-1",),
    ]


def test_arriving_is_success_and_a_crash_in_the_goal_row_is_not() -> None:
    there = av_at(ROAD, (0, 0))
    assert outcome(there, (), 50) is Outcome.SUCCESS
    assert outcome(there, (Cause("hit", Kind.POTHOLE, ("pothole-9",), (0, 0)),), 50) is Outcome.CRASH


def test_every_vehicle_has_to_arrive() -> None:
    assert outcome(av_at(ROAD, (0, 0), (1, 4)), (), 50) is Outcome.RUNNING
    assert outcome(av_at(ROAD, (0, 0), (1, 0)), (), 50) is Outcome.SUCCESS


def test_stuck_is_more_than_the_ticks_allowed() -> None:
    at = {n: replace(ROAD, tick=7 + n, episode_start=7) for n in (50, 51)}
    assert outcome(at[50], (), 50) is Outcome.RUNNING
    assert outcome(at[51], (), 50) is Outcome.STUCK
    assert outcome(av_at(at[51], (0, 0)), (), 50) is Outcome.SUCCESS
