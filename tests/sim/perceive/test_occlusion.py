"""What bodies hide, against a slow exact check."""

from __future__ import annotations

import pytest

from sim.perceive.occlusion import hidden
from sim.types import KINDS, Cell, Kind
from sim.world.grid import Road, board_of, cells_of
from tools.check_occlusion import differences

ROAD = Road.of(5, 8)
EGO: Cell = (2, 7)


def hidden_cells(kind: Kind, *bodies: Cell) -> set[Cell]:
    found = hidden(ROAD, ROAD.index(EGO), 7, [(kind, board_of(map(ROAD.index, bodies)))])
    return {ROAD.cell(cell) for cell in cells_of(found)}


def test_a_car_right_ahead_hides_what_is_straight_behind_it() -> None:
    found = hidden_cells(Kind.VEHICLE, (2, 6))
    assert {(2, row) for row in range(6)} <= found
    assert (2, 6) not in found
    assert {(0, 6), (4, 6), (0, 5), (4, 5), (1, 6)}.isdisjoint(found)


def test_a_body_in_a_corner_of_the_view_hides_the_diagonal_behind_it_alone() -> None:
    assert hidden_cells(Kind.BARRIER, (1, 6)) & {(0, 5), (2, 5), (1, 5)} == {(0, 5)}


def test_no_body_hides_its_own_cell_or_one_before_it() -> None:
    assert hidden_cells(Kind.VEHICLE, (2, 3)) == {(2, 2), (2, 1), (2, 0)}


@pytest.mark.parametrize("kind", [Kind.POTHOLE, Kind.PEDESTRIAN])
def test_what_is_low_or_thin_hides_nothing(kind: Kind) -> None:
    assert not KINDS[kind].occludes


def test_ray_casting_agrees_with_clipping_in_fractions() -> None:
    compared, unseen, wrong = differences(4_000, seed=3)
    assert wrong == 0
    assert compared == 4_000
    assert 400 < unseen < 3_600
