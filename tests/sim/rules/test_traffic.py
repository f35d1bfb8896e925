"""Each clause of the rule of motion on a road small enough to read, then what must hold on any."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from sim.commit import commit
from sim.rules.traffic import steps_in_tick
from sim.types import Kind, Move
from sim.world import World, notation
from sim.world.grid import bits
from tests.support.roads import grid, mirrored, road, run_on, worlds

EMPTY = "......."


def after(*rows: str, tick: int = 0, courtesy: float = 0.0) -> list[str]:
    """The rows one tick later, the vehicle staying where it is."""
    world = road(*rows, tick=tick)
    return grid(commit(world, (Move.STAY,), run_on(world, courtesy=courtesy).config))


def row_after(row: str, *, tick: int = 0, courtesy: float = 0.0) -> str:
    """One row one tick later; the vehicle waits two rows below unless it is in the row."""
    below = EMPTY if "A" in row else "...A..."
    return after(EMPTY, row, EMPTY, below, tick=tick, courtesy=courtesy)[1]


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ("..>....", "...>..."),
        ("....<..", "...<..."),
        # The road's edge: turn round and go.
        ("......>", ".....<."),
        ("<......", ".>....."),
        # A pothole or a barrier in the way.
        ("..>o...", ".<.o..."),
        ("..>#...", ".<.#..."),
        ("..o<...", "..o.>.."),
        # Blocked on both sides: stay, facing the new way.
        (".o>#...", ".o<#..."),
        (".#<o...", ".#>o..."),
        ("o>o....", "o<o...."),
        ("#>.....", "#.>...."),
        # A mover standing there blocks, even one that is about to leave.
        ("..>>...", ".<..>.."),
        ("..<<...", ".<..>.."),
        # Two that want one cell are both blocked; both turn.
        ("..>.<..", ".<...>."),
        # … and stay facing the new way when the way back is closed.
        (".o>.<o.", ".o<.>o."),
        # Face to face: each stands in the other's way, each turns.
        ("..><...", ".<..>.."),
        # A cell won by one that went straight is taken for one that turned.
        (">.>o...", ".><o..."),
        # Two that turned round want one cell: both are blocked again.
        ("o<.>o..", "o>.<o.."),
        # A cell left in this tick does not count as free.
        ("o.>>#..", "o<.<#.."),
    ],
)
def test_a_tick_of_vehicles(row: str, expected: str) -> None:
    assert row_after(row) == expected


@pytest.mark.parametrize(
    ("row", "tick", "expected"),
    [
        ("..)....", 0, "..)...."),
        ("..)....", 1, "...)..."),
        ("....(..", 0, "....(.."),
        ("....(..", 1, "...(..."),
        # Between two steps a pedestrian does not turn, and it blocks as anyone standing does.
        ("..)o...", 0, "..)o..."),
        ("..)o...", 1, ".(.o..."),
        (".>)....", 0, "<.)...."),
        # One that walks and one that drives contest a cell like any two.
        (".).<...", 1, "(...>.."),
        (".).<...", 0, ".)<...."),
    ],
)
def test_pedestrians_step_in_odd_ticks_of_the_episode(row: str, tick: int, expected: str) -> None:
    assert row_after(row, tick=tick) == expected


def test_the_beat_counts_from_the_start_of_the_episode() -> None:
    assert [steps_in_tick(2, tick) for tick in range(4)] == [False, True, False, True]
    world = road(EMPTY, "..)....", EMPTY, "...A...", tick=0)
    text = "road 7x4 tick 8 episode 2 from 7 running"
    later = notation.read(notation.write(world).replace("road 7x4 tick 0 episode 1 from 0 running", text))
    assert grid(commit(later, (Move.STAY,), run_on(later).config))[1] == "...)..."


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ("..}....", "..}...."),
        ("...{...", "...{..."),
        ("..].[..", "..].[.."),
        # It stands in the way like anything that stands.
        (".>}....", "<.}...."),
        ("...}<..", "...}.>."),
    ],
)
def test_a_mover_in_a_pothole_stays_facing_as_it_did(row: str, expected: str) -> None:
    assert row_after(row, tick=1) == expected


@pytest.mark.parametrize(
    ("row", "discourteous", "courteous"),
    [
        ("..>A...", "A over >", ".<.A..."),
        ("...A<..", "A over <", "...A.>."),
        (".o>A...", "A over >", ".o<A..."),
        # A courteous mover that yields still contests: neither enters.
        ("..>A<..", ".<.A.>.", ".<.A.>."),
        # What does not touch the vehicle is the same for both.
        (".>.A.<.", None, None),
    ],
)
def test_a_courteous_mover_counts_the_vehicle_as_blocking(
    row: str, discourteous: str | None, courteous: str | None
) -> None:
    world = road(EMPTY, row, EMPTY, EMPTY)
    bold = commit(world, (Move.STAY,), run_on(world).config)
    polite = commit(world, (Move.STAY,), run_on(world, courtesy=1.0).config)
    if courteous is None:
        assert bold == polite
        return
    assert grid(polite)[1] == courteous
    if discourteous is not None and discourteous.startswith("A over"):
        assert bold.moving >> bold.av & 1
    else:
        assert grid(bold)[1] == discourteous


def test_courtesy_is_drawn_for_one_mover_and_tick_at_a_time() -> None:
    world = road("...", ">A<", *["..."] * 8)
    # One of the two is taken away, so that no contest hides the draw.
    lone = world.without({"vehicle-2"})
    entered = 0
    for seed in range(400):
        moved = commit(lone, (Move.STAY,), run_on(lone, courtesy=0.25, seed=seed).config)
        entered += moved.moving >> moved.av & 1
    assert 0.75 * 400 - 45 < entered < 0.75 * 400 + 45


def step(world: World) -> World:
    return commit(world, (Move.STAY,), run_on(world).config)


@settings(max_examples=150, deadline=None)
@given(worlds())
def test_movers_are_neither_lost_nor_doubled_nor_changed(world: World) -> None:
    later = step(world)
    assert later.right & later.left == 0
    assert later.moving.bit_count() == world.moving.bit_count()
    assert later.pedestrians & ~later.moving == 0
    assert set(later.movers) == set(bits(later.moving))
    assert sorted(later.movers.values()) == sorted(world.movers.values())
    for kind in (Kind.VEHICLE, Kind.PEDESTRIAN):
        was = {world.id_at(cell, kind) for cell in bits(world.board(kind))}
        assert {later.id_at(cell, kind) for cell in bits(later.board(kind))} == was


@settings(max_examples=150, deadline=None)
@given(worlds())
def test_movers_keep_to_their_row_off_hazards_and_go_one_cell_at_most(world: World) -> None:
    later = step(world)
    was = {name: world.road.cell(cell) for cell, name in world.movers.items()}
    for cell, name in later.movers.items():
        column, row = later.road.cell(cell)
        assert row == was[name][1]
        assert abs(column - was[name][0]) <= 1
        if (column, row) != was[name]:
            assert not later.fixed >> cell & 1
            assert not world.moving >> cell & 1
    assert (later.potholes, later.barriers) == (world.potholes, world.barriers)


@settings(max_examples=200, deadline=None)
@given(worlds())
def test_a_mirrored_road_behaves_as_the_mirror_image(world: World) -> None:
    there = world
    back = mirrored(world)
    for _ in range(4):
        there, back = step(there), step(back)
        assert mirrored(there) == back


@settings(max_examples=100, deadline=None)
@given(worlds())
def test_what_happens_in_a_row_is_no_matter_to_another(world: World) -> None:
    later = step(world)
    for row in range(world.road.rows):
        others = {
            name
            for table in (world.movers, world.hazards)
            for cell, name in table.items()
            if cell // world.road.columns != row
        }
        alone = step(world.without(others))
        here = world.road.row(row)
        assert (alone.right & here, alone.left & here) == (later.right & here, later.left & here)
