"""Tests for `sim.search.way_ahead`: what it finds is there, and it looks at few states."""

from __future__ import annotations

import pytest

from sim.actions import Set, SetCount
from sim.config import Config
from sim.oracle.lower_bounds import can_arrive, foreseen
from sim.search.reactive import ReactiveSearch
from sim.search.way_ahead import finds_way_ahead
from sim.session.timeline import Timeline
from sim.state import SimState


def _road(seed: int, *, potholes: int) -> SimState:
    timeline = Timeline(Config(seed=seed))
    timeline.apply(1, [Set(parameter="courtesy", value=0.4)])
    timeline.apply(2, [SetCount(kind="pothole", count=potholes), SetCount(kind="vehicle", count=12)])
    return timeline.state


def _finds(state: SimState, states: int) -> bool:
    forecast, limit = foreseen(state)
    return finds_way_ahead(ReactiveSearch(state.world, state.config, forecast), limit, states)


@pytest.mark.parametrize("potholes", [5, 50])
def test_it_finds_no_way_where_there_is_none_and_hardly_misses_one(potholes: int) -> None:
    found = there = 0
    for seed in range(12):
        state = _road(seed, potholes=potholes)
        arrives = can_arrive(state)
        ahead = _finds(state, 100)
        assert arrives or not ahead, seed
        assert can_arrive(state, states_ahead=100) == arrives, seed
        found, there = found + ahead, there + arrives
    assert found >= there - 2


def test_it_gives_up_within_its_bound() -> None:
    assert not _finds(_road(3, potholes=5), 2)
