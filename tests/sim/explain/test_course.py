"""Lane changes and what was passed, against a count by hand of cells and things."""

from __future__ import annotations

from itertools import pairwise

import pytest

from sim.config import Config
from sim.explain.occurrences import Event, Query, occurrences
from sim.explain.passed import passed
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Outcome


def driven(ticks: int, **values: object) -> Timeline:
    timeline = Timeline(Config(**values))  # type: ignore[arg-type]
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


@pytest.mark.parametrize("seed", range(12))
def test_lane_changes_are_those_of_the_columns(seed: int) -> None:
    timeline = driven(40, seed=seed, potholes=25, vehicles=8, planner="astar" if seed % 2 else "rules")
    states = list(timeline.between(0, timeline.tick + 1))
    columns = [state.world.road.cell(state.world.av)[0] for state in states]
    steps = [there - here for here, there in pairwise(columns)]
    found = occurrences(timeline, Query(event=Event.LANE_CHANGE))
    assert [each.tick for each in found.found] == [tick for tick, step in enumerate(steps) if step]
    assert [each.left for each in found.found] == [step < 0 for step in steps if step]
    assert found.driven == timeline.tick


def test_a_step_that_slips_changes_no_lane() -> None:
    slipped = driven(
        40, seed=3, potholes=30, vehicles=4, planner="astar", weather="snow", slip_probability=1.0
    )
    assert occurrences(slipped, Query(event=Event.LANE_CHANGE)).found == ()


@pytest.mark.parametrize("seed", range(8))
def test_what_was_passed_was_ahead_and_is_behind(seed: int) -> None:
    timeline = driven(18, seed=seed, potholes=12, vehicles=10, pedestrians=5, barriers=3, planner="astar")
    states = list(timeline.between(0, timeline.tick + 1))
    ahead, behind = set(), set()
    for state in states:
        row = state.world.road.cell(state.world.av)[1]
        ahead |= {thing.id for thing in state.world.things() if thing.cell[1] < row}
        behind |= {thing.id for thing in state.world.things() if thing.cell[1] > row}
    found = passed(timeline)
    assert set(found.ids) == set(PLACEABLE)
    assert {name for ids in found.ids.values() for name in ids} == ahead & behind
    for kind, ids in found.ids.items():
        assert all(name.startswith(f"{kind.value}-") for name in ids)


def test_at_the_start_nothing_was_passed() -> None:
    timeline = driven(0, seed=1)
    assert not any(passed(timeline).ids.values())
    assert occurrences(timeline, Query(event=Event.LANE_CHANGE)).driven == 0
