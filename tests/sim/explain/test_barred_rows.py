"""Rows of barriers ahead against the road itself, and ways through gaps against ways that are driven."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain.barred_rows import barred_rows
from sim.oracle.lower_bounds import can_arrive
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world
from sim.types import Kind, Move, Outcome

SEEDS = range(10)


def begun(seed: int, ticks: int = 4, **more: object) -> Timeline:
    config = Config(columns=5, rows=16, vehicles=5, potholes=3, barriers=12, seed=seed, solvable=False)
    timeline = Timeline(config.with_parts(**more))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("seed", SEEDS)
def test_lanes_of_a_row_are_those_that_hold_nothing_that_stands(seed: int) -> None:
    state = begun(seed).state
    found = barred_rows(state)
    own = state.world.road.cell(state.world.av)[1]
    standing: dict[int, set[int]] = {}
    for thing in state.world.things():
        if thing.kind in (Kind.BARRIER, Kind.POTHOLE):
            standing.setdefault(thing.cell[1], set()).add(thing.cell[0] + 1)
    assert [row.ahead for row in found.rows] == sorted(row.ahead for row in found.rows)
    for row in found.rows:
        assert row.row == own - row.ahead < own
        assert set(row.barriers + row.potholes) == standing[row.row]
        assert set(row.free) == set(range(1, 6)) - standing[row.row]


def reached(state: SimState, cell: int, ticks: int) -> bool:
    """Whether some moves lead to a cell in so many ticks, played one by one."""
    worlds = [state.world]
    config = state.config
    for _ in range(ticks):
        after = {}
        for world in worlds:
            dynamics = config.ego_dynamics(world.road)
            for move in (each for each in Move if dynamics.target(world.av, each) is not None):
                then = next_world(world, (move,), config)
                if then.outcome in (Outcome.RUNNING, Outcome.SUCCESS):
                    after[then.av] = then
        worlds = list(after.values())
    return any(world.av == cell for world in worlds)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_gap_is_got_to_as_soon_as_it_is_told_and_not_where_what_stands_shuts_it_off(seed: int) -> None:
    state = begun(seed, attentive=0.0, courtesy=0.0).state
    found = barred_rows(state)
    for gap in found.gaps:
        cell = state.world.road.index((gap.lane - 1, found.rows[0].row))
        assert not (gap.shut_off and gap.ticks is not None)
        if gap.ticks is not None:
            assert reached(state, cell, gap.ticks)
            assert not any(reached(state, cell, ticks) for ticks in range(gap.ticks))
        if gap.leads_on:
            assert can_arrive(state, 20_000)


def test_some_gaps_lead_on_and_some_do_not() -> None:
    gaps = [gap for seed in range(30) for gap in barred_rows(begun(seed).state).gaps]
    assert {gap.leads_on for gap in gaps} == {True, False}
    assert any(gap.shut_off for gap in gaps)


def test_of_a_drive_that_has_ended_no_way_is_looked_for() -> None:
    ended = [begun(seed, 60).state for seed in SEEDS]
    ended = [state for state in ended if state.world.outcome is not Outcome.RUNNING]
    assert ended
    assert all(barred_rows(state).gaps == () for state in ended)
