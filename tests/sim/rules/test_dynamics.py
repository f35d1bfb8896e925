"""The motion of the vehicle: what a step sweeps, by geometry, and whole boards against single cells."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.rules.collision_geometry import Path, first_contact
from sim.rules.dynamics import Dynamics, Swept
from sim.rules.dynamics_registry import dynamics_on
from sim.rules.grid_dynamics import GridDynamics
from sim.types import MOVERS, MOVES, Kind, Move
from sim.world.grid import Board, Road, bits

SIZES = st.tuples(st.integers(3, 9), st.integers(2, 7))


class CellByCell(Dynamics):
    """The grid's motion with everything derived from its single steps."""

    name = "cell by cell"
    rows_a_tick = 1

    def __init__(self, road: Road, *, bodies: bool) -> None:
        super().__init__(road, bodies=bodies)
        self.step = GridDynamics(road, bodies=bodies).step  # type: ignore[method-assign]


@st.composite
def moments(draw: st.DrawFn) -> tuple[Road, bool, Board, Board, Board, Board]:
    """A road, whether bodies collide, and boards: vehicles, taken cells, cells entered from either side."""
    road = Road.of(*draw(SIZES))
    boards = st.integers(0, road.all)
    came_right = draw(boards) & ~road.left_edge
    came_left = draw(boards) & ~road.right_edge & ~came_right
    blocked = draw(boards) & draw(boards) | came_right | came_left
    return road, draw(st.booleans()), draw(boards), blocked, came_right, came_left


@settings(max_examples=300, deadline=None)
@given(moments())
def test_whole_boards_say_what_single_cells_say(
    moment: tuple[Road, bool, Board, Board, Board, Board],
) -> None:
    road, bodies, start, blocked, came_right, came_left = moment
    fast, slow = GridDynamics(road, bodies=bodies), CellByCell(road, bodies=bodies)
    met = blocked, came_right, came_left
    assert fast.steps(start, *met) == slow.steps(start, *met)
    assert fast.spread(start, *met) == slow.spread(start, *met)
    free = start & ~blocked
    assert fast.spread_back(free, *met) == slow.spread_back(free, *met)
    assert fast.ends_anywhere(start) == slow.ends_anywhere(start)
    assert fast.may_come_from(start, start & blocked) == slow.may_come_from(start, start & blocked)
    obstacles, same = fast.obstacles(*met), slow.obstacles(*met)
    for cell in range(road.columns, road.columns * road.rows):
        assert fast.free_ends(obstacles, cell) == slow.free_ends(same, cell)
        assert [move for move in MOVES if slow.target(cell, move) is not None] == [*fast.actions(cell)]


@settings(max_examples=100, deadline=None)
@given(moments())
def test_back_is_the_reverse_of_forth(moment: tuple[Road, bool, Board, Board, Board, Board]) -> None:
    road, bodies, start, blocked, came_right, came_left = moment
    motion = GridDynamics(road, bodies=bodies)
    met = blocked, came_right, came_left
    ends = start & ~blocked
    back = motion.spread_back(ends, *met)
    leads = [cell for cell in range(road.columns * road.rows) if motion.spread(1 << cell, *met) & ends]
    assert list(bits(back)) == leads
    assert motion.unhindered(start) & ~blocked & ~motion.spread(start, *met) == 0


@pytest.mark.parametrize("kind", [*MOVERS, Kind.BARRIER, Kind.POTHOLE])
@pytest.mark.parametrize("move", MOVES)
def test_what_a_step_sweeps_is_what_its_body_touches(move: Move, kind: Kind) -> None:
    """Every way of every thing around, by the geometry of boxes that move linearly."""
    road = Road.of(7, 7)
    start = road.index((3, 3))
    end, swept = GridDynamics(road, bodies=True).step(start, move) or (-1, Swept(()))
    own = Path(Kind.AV, road.cell(start), road.cell(end))
    for cell in range(road.columns * road.rows):
        column, row = road.cell(cell)
        for origin in (0, -1, 1) if kind in MOVERS else (0,):
            if not 0 <= column + origin < road.columns:
                continue
            met = cell in swept.cells
            met |= origin == -1 and cell in swept.from_left
            met |= origin == 1 and cell in swept.from_right
            other = Path(kind, (column + origin, row), (column, row))
            touched = first_contact(own, other)
            if (column + origin, row) == (3, 3):
                continue  # nothing is where the vehicle stands
            assert met is (touched is not None), (other, touched)
            assert touched is None or Fraction(0) <= touched < 1


def test_one_object_for_the_same_road() -> None:
    assert dynamics_on(Road(5, 7)) is dynamics_on(Road.of(5, 7), "grid", True)
    assert dynamics_on(Road.of(5, 7), bodies=False).step(17, Move.FORWARD_LEFT) == (11, Swept((11,)))


@settings(max_examples=60, deadline=None)
@given(st.data(), SIZES, st.booleans())
def test_the_table_of_contacts_of_egos_says_what_bodies_on_straight_ways_say(
    data: st.DataObject, size: tuple[int, int], bodies: bool
) -> None:
    road = Road.of(*size)
    fast, slow = GridDynamics(road, bodies=bodies), CellByCell(road, bodies=bodies)
    cell = data.draw(st.integers(0, road.columns * road.rows - 1))
    move = data.draw(st.sampled_from(fast.actions(cell)))
    assert fast.denied(cell, move) == slow.denied(cell, move)
    theirs = cell, fast.target(cell, move) or 0
    for start in range(road.columns * road.rows):
        for own in fast.actions(start):
            end = fast.target(start, own)
            if end is not None and start != cell:
                assert fast.egos_touch((start, end), theirs) == slow.egos_touch((start, end), theirs)
