"""The checker finds each broken promise, and none in the planners there are."""

from __future__ import annotations

import pytest

from sim.plan import Planner, planner_named
from sim.plan.conformance import check, moments
from tests.support import faulty_planners as faulty

BROKEN = {
    faulty.Raises: "answers",
    faulty.Nonsense: "legal",
    faulty.Sideways: "legal",
    faulty.Leaves: "legal",
    faulty.Lies: "honest",
    faulty.Careless: "careful",
    faulty.Remembers: "deterministic",
    faulty.Meddles: "harmless",
    faulty.Peeps: "bounded",
    faulty.Endless: "answers",
}


@pytest.mark.parametrize("planner", BROKEN)
def test_a_broken_promise_is_found(planner: type[Planner]) -> None:
    report = check(planner(), moments(8))
    assert BROKEN[planner] in {defect.promise for defect in report.defects}


@pytest.mark.parametrize("name", ["rules", "priority", "astar", "dijkstra", "bfs"])
def test_the_planners_there_are_keep_their_promises(name: str) -> None:
    planner = planner_named(name)
    assert planner is not None
    report = check(planner)
    assert report.decisions > 100
    assert report.defects == ()


def test_a_planner_of_another_package_may_keep_them_too() -> None:
    assert check(faulty.Good(), moments(8)).defects == ()
