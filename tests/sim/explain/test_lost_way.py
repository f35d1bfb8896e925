"""Since when no way is left, against searches at every tick; the move that keeps one, by making it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from sim.config import Config
from sim.explain.alternatives import after_move
from sim.explain.lost_way import LostWay, lost_way
from sim.explain.question_error import QuestionError
from sim.oracle.lower_bounds import can_arrive
from sim.session.timeline import Timeline
from sim.types import Outcome

SEEDS = range(40)


@cache
def ended(seed: int, **more: object) -> Timeline:
    config = Config(columns=6, rows=18, vehicles=3, pedestrians=1, seed=seed, layout="dead_ends")
    timeline = Timeline(config.with_parts(**{"planner": "priority"} | more))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def stuck() -> list[tuple[Timeline, LostWay]]:
    all_ended = [ended(seed) for seed in SEEDS]
    return [(each, lost_way(each)) for each in all_ended if each.state.world.outcome is Outcome.STUCK]


def test_drives_that_get_stuck_are_among_them() -> None:
    found = [each for _, each in stuck()]
    assert len(found) >= 4
    assert {each.open for each in found} >= {False}
    assert any(each.exact for each in found)


def test_no_way_is_left_from_the_tick_on_and_one_was_before() -> None:
    for timeline, found in stuck():
        if found.open is not False or found.shut_at is None:
            continue
        first, stop = found.shut_at.world.tick, found.state.world.tick
        assert not any(can_arrive(each) for each in timeline.between(first, stop + 1))
        if found.last_open is not None:
            assert found.last_open.world.tick < first
            assert can_arrive(found.last_open)
            assert found.exact or found.last_open.world.tick + 1 < first
        else:
            assert first == found.first


def test_the_other_move_keeps_a_way_and_the_one_that_was_made_does_not() -> None:
    kept = 0
    for _, found in stuck():
        if found.last_open is None or not found.exact or found.instead is None or found.made is None:
            continue
        ego = found.last_open.ego().id
        assert can_arrive(after_move(found.last_open, found.instead, ego))
        assert not can_arrive(after_move(found.last_open, found.made, ego))
        kept += 1
    assert kept


def test_what_closes_the_way_opens_it_when_it_is_gone() -> None:
    named = 0
    for _, found in stuck():
        if found.shut_at is None or found.shut is None or not found.shut.ids:
            continue
        assert not can_arrive(found.shut_at)
        opened = found.shut_at.world.without(frozenset(found.shut.ids))
        assert can_arrive(replace(found.shut_at, world=opened))
        named += 1
    assert named


def test_with_a_poor_sensor_it_is_told_when_all_of_that_was_detected() -> None:
    seen = set()
    for seed in SEEDS:
        timeline = ended(seed, sensor="camera", weather="fog")
        if timeline.state.world.outcome is not Outcome.STUCK:
            continue
        found = lost_way(timeline)
        if found.shut is not None and found.shut.ids and found.shut_at is not None:
            seen.add(found.detected is not None)
            assert found.detected is None or found.first <= found.detected <= timeline.tick
    assert seen


def test_a_drive_that_ended_otherwise_has_no_answer_and_one_that_goes_on_has() -> None:
    drives = (ended(seed, planner="astar") for seed in range(9))
    other = next(each for each in drives if each.state.world.outcome is not Outcome.STUCK)
    with pytest.raises(QuestionError, match="ended_otherwise"):
        lost_way(other)
    fresh = Timeline(Config(columns=6, rows=18, vehicles=3, seed=1))
    found = lost_way(fresh)
    assert found.open is True
    assert found.plan
