"""Boxes that move in straight lines touch exactly where the rule in cells says so, and nowhere else."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.render.motion import STEP_FRAMES, poses
from sim.rules.collision_geometry import SIZES, Path, clearance, first_contact
from sim.types import HAZARDS, MOVERS, Kind, Move, Outcome
from tools.contacts import TABLE, Case, cases, table, worlds, written

DIAGONALS = (Move.FORWARD_LEFT, Move.FORWARD_RIGHT)


def test_every_contact_is_counted_by_the_rule_and_every_case_of_the_rule_is_a_contact() -> None:
    for case in cases():
        assert (case.contact is not None) == (case.words is not None), case


def test_the_cases_are_all_there_are() -> None:
    every = list(cases())
    assert len(set(every)) == len(every) == 6 * 24 * (3 * len(MOVERS) + len(HAZARDS))
    found = {case.words for case in every} - {None}
    assert found == {"same cell", "swap", "met on the diagonal, from behind", "met on the diagonal, ahead"}


def test_the_diagonal_cases_are_these() -> None:
    met = {(case.move, case.offset, case.step) for case in cases() if "diagonal" in (case.words or "")}
    assert met == {
        (Move.FORWARD_LEFT, (-1, 0), 1),
        (Move.FORWARD_LEFT, (-1, -1), 1),
        (Move.FORWARD_RIGHT, (1, 0), -1),
        (Move.FORWARD_RIGHT, (1, -1), -1),
    }


@pytest.mark.parametrize("kind", list(Kind))
def test_nothing_that_a_vehicle_passes_reaches_across_the_corner(kind: Kind) -> None:
    assert 0 <= clearance(Kind.AV, kind) < Fraction(1, 4)


@pytest.mark.parametrize("kind", [Kind.BARRIER, Kind.POTHOLE])
@pytest.mark.parametrize("move", DIAGONALS)
@pytest.mark.parametrize("offset", [(-1, 0), (0, -1), (1, 0)])
def test_a_diagonal_cuts_the_corner_beside_what_is_fixed(
    kind: Kind, move: Move, offset: tuple[int, int]
) -> None:
    assert Case(move, kind, offset, 0).contact is None


def test_the_room_at_the_corner_is_what_keeps_it_free() -> None:
    """Were a pothole a hundredth wider than half a cell and a bit, the corner would be touched."""
    across, along = (Fraction(1, 2) + 2 * clearance(Kind.AV, Kind.POTHOLE) + Fraction(1, 100)), Fraction(1, 2)
    av = SIZES[Kind.AV]
    assert (av.across + across + av.along + along) / 2 > 1


def test_first_contacts_are_exact() -> None:
    def when(move: Move, kind: Kind, offset: tuple[int, int], step: int) -> Fraction | None:
        return Case(move, kind, offset, step).contact

    assert when(Move.FORWARD, Kind.VEHICLE, (0, -1), 0) == Fraction(51, 100)
    assert when(Move.FORWARD, Kind.POTHOLE, (0, -1), 0) == Fraction(42, 100)
    assert when(Move.STAY, Kind.VEHICLE, (-1, 0), 1) == Fraction(51, 100)
    assert when(Move.LEFT, Kind.VEHICLE, (-1, 0), 1) == Fraction(51, 200)
    assert when(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, 0), 1) == Fraction(51, 200)
    assert when(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, -1), 1) == Fraction(51, 100)
    assert when(Move.FORWARD_LEFT, Kind.PEDESTRIAN, (-1, 0), 1) == Fraction(69, 200)
    assert when(Move.FORWARD, Kind.VEHICLE, (0, -1), 1) is None


def test_what_overlaps_from_the_beginning_touches_at_once() -> None:
    here = Path(Kind.AV, (0, 0), (0, -1))
    assert first_contact(here, Path(Kind.VEHICLE, (0, 0), (1, 0))) == 0


cells = st.tuples(st.integers(-2, 2), st.integers(-2, 2))
paths = st.builds(Path, st.sampled_from(list(Kind)), cells, cells)


@given(paths, paths)
def test_it_is_the_first_of_a_thousand_moments_that_overlaps(one: Path, other: Path) -> None:
    def overlap(share: Fraction) -> bool:
        return all(
            abs(
                (other.start[axis] + (other.end[axis] - other.start[axis]) * share)
                - (one.start[axis] + (one.end[axis] - one.start[axis]) * share)
            )
            < (SIZES[one.kind][axis] + SIZES[other.kind][axis]) / 2
            for axis in (0, 1)
        )

    when = first_contact(one, other)
    assert when == first_contact(other, one)
    moments = [Fraction(n, 1000) for n in range(1001)]
    found = next((share for share in moments if overlap(share)), None)
    if when is None:
        assert found is None
    else:
        assert found is None or found >= when
        assert overlap(when + Fraction(1, 10**6))
        assert when == 0 or not overlap(when)


def test_what_is_drawn_touches_only_in_a_crash_and_stops_there() -> None:
    for case in cases():
        before, after = worlds(case)
        for frame in range(STEP_FRAMES + 1):
            seen = poses(before, after, frame / STEP_FRAMES)
            (left, top, right, bottom), other = seen.av.box, seen.things[0].box
            deep = min(right - other[0], other[2] - left, bottom - other[1], other[3] - top)
            assert deep < 1e-9, (case, frame)
        crashed = after.outcome is Outcome.CRASH
        assert (seen.touch is not None) == crashed == (abs(deep) < 1e-9), case
        assert crashed == (seen.share < 1), case


def test_the_page_is_compared_with_what_is_so_now() -> None:
    assert TABLE.read_text(encoding="utf-8") == written(), "python -m tools.contacts --write"


def test_the_table_counts_every_contact() -> None:
    told = table()
    assert "NOT COUNTED" not in told
    assert "never" not in told
