"""Where others go and who crosses ahead, against the road driven on; what was hit, against two states."""

from __future__ import annotations

from itertools import islice

import pytest

from sim.config import Config
from sim.explain.advance import advance
from sim.explain.hit_mover import hit_movers
from sim.explain.occurrences import Event, Query
from sim.explain.others_ahead import CROSSING_ROWS, CROSSING_TICKS, crossing, others_ahead
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Kind, Move, Outcome

SEEDS = range(12)


def begun(seed: int, ticks: int) -> Timeline:
    timeline = Timeline(Config(columns=6, rows=24, vehicles=14, pedestrians=4, potholes=3, seed=seed))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def columns(timeline: Timeline) -> dict[str, tuple[int, int]]:
    return {each.id: each.cell for each in timeline.state.world.things() if each.heading is not None}


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_told_of_others_is_what_the_same_road_then_does(seed: int) -> None:
    timeline = begun(seed, seed % 7)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        with pytest.raises(QuestionError):
            others_ahead(timeline, None)
        return
    told, crossed = others_ahead(timeline, None), crossing(timeline, None)
    lane, row = timeline.state.world.road.cell(timeline.state.world.av)
    at = [columns(timeline)]
    while len(at) <= CROSSING_TICKS and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
        at.append(columns(timeline))
    assert crossed.ticks == len(at) - 1
    assert {thing.id for thing, _ in told.ways} == set(at[0])
    for thing, move in told.ways:
        within = 2 if thing.kind is Kind.PEDESTRIAN else 1
        across = next((d for each in at[1 : 1 + within] if (d := each[thing.id][0] - thing.cell[0])), 0)
        assert move.offset[0] == (across > 0) - (across < 0)
    expected = {
        id: next((tick for tick, each in enumerate(at) if each[id][0] == lane), None)
        for id, cell in at[0].items()
        if row - CROSSING_ROWS <= cell[1] < row
    }
    assert dict(crossed.coming) == {id: tick for id, tick in expected.items() if tick is not None}
    assert [tick for _, tick in crossed.coming] == sorted(tick for _, tick in crossed.coming)


def test_kinds_are_told_apart() -> None:
    timeline = begun(1, 2)
    both = len(others_ahead(timeline, None).ways)
    assert both == sum(len(others_ahead(timeline, kind).ways) for kind in (Kind.VEHICLE, Kind.PEDESTRIAN))
    assert others_ahead(timeline, Kind.POTHOLE).ways == ()


def test_what_was_hit_is_told_as_the_two_states_show_it() -> None:
    seen = set()
    for seed in range(60):
        config = Config(
            columns=5, rows=18, vehicles=14, pedestrians=3, potholes=3, barriers=4, seed=seed, sensor="radar"
        )
        timeline = Timeline(config.with_parts(weather="rain"))
        while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < 60:
            timeline.advance()
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        before, after = islice(timeline.between(timeline.tick - 1, timeline.tick + 1), 2)
        own, own_then = (each.world.road.cell(each.world.av) for each in (before, after))
        for each in hit_movers(timeline).found:
            was = before.world.find(each.id)
            then = after.world.find(each.id)
            assert was is not None
            assert then is not None
            step = then.cell[0] - was.cell[0]
            assert (each.move is Move.STAY, each.speed_kmh == 0) == (step == 0, step == 0)
            assert each.across == was.cell[0] - own[0]
            assert each.clear_if_stayed == (None if step == 0 else own_then != was.cell)
            seen.add((each.kind, each.move))
    assert len(seen) >= 3


@pytest.mark.parametrize("seed", SEEDS)
def test_rows_are_those_between_the_cells_of_the_first_and_the_last_tick(seed: int) -> None:
    timeline = begun(seed, 9)
    row = [each.world.road.cell(each.world.av)[1] for each in timeline.between(0, timeline.tick + 1)]
    assert advance(timeline, Query(event=Event.DRIVE)).rows == row[0] - row[-1]
    back = min(4, timeline.tick)
    found = advance(timeline, Query(event=Event.DRIVE, first=timeline.tick - back))
    assert (found.rows, found.ticks) == (row[-1 - back] - row[-1], back)
    between = advance(timeline, Query(event=Event.DRIVE, first=1, last=timeline.tick - 1))
    assert (between.rows, between.ticks) == (row[1] - row[-2], timeline.tick - 2)
    with pytest.raises(QuestionError):
        advance(timeline, Query(event=Event.DRIVE, first=timeline.tick + 5))
