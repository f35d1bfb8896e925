"""Driving to a lane: it is kept once reached, nothing leads away from it before, and the run is real."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain.driving_policy import Policy, policy_run
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.transition import next_world
from sim.types import Outcome

SEEDS = range(8)


def begun(seed: int, ticks: int = 4) -> Timeline:
    timeline = Timeline(Config(columns=6, rows=20, vehicles=8, potholes=6, seed=seed))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("lane", [1, 4, 6])
def test_a_lane_is_approached_and_then_kept(seed: int, lane: int) -> None:
    timeline = begun(seed)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        return
    found = policy_run(timeline, Policy.TO_LANE, lane=lane)
    world, columns = timeline.state.world, []
    for move in found.path:
        columns.append(world.road.cell(world.av)[0] + 1)
        world = next_world(world, (move,), timeline.state.config)
    assert world.outcome is found.outcome
    columns.append(world.road.cell(world.av)[0] + 1)
    off = [abs(column - lane) for column in columns]
    assert off == sorted(off, reverse=True)
    assert found.lane_after == (off.index(0) if 0 in off else None)
    assert found.ticks_in_lane == columns[:-1].count(lane)


def test_a_lane_off_the_road_is_none() -> None:
    for lane in (7, 40):
        with pytest.raises(QuestionError, match="no_such_lane"):
            policy_run(begun(1), Policy.TO_LANE, lane=lane)


def test_from_the_start_it_is_driven_otherwise_than_from_now() -> None:
    timeline = begun(2, 6)
    start = policy_run(timeline, Policy.TO_LANE, 0, lane=1)
    now = policy_run(timeline, Policy.TO_LANE, lane=1)
    assert (start.state.world.tick, now.state.world.tick) == (0, timeline.tick)
