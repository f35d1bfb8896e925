"""Near misses, the risk of a move and figures of a drive: what is told is what the drive shows."""

from __future__ import annotations

from itertools import pairwise

import pytest

from sim.config import Config
from sim.explain.closest_call import NEAR_MISS_M, closest_calls, near_misses
from sim.explain.drive_figures import best_time, drive_so_far
from sim.explain.move_risk import move_risk
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Outcome
from tests.narration.test_by_hand import NARRATORS, YES_NO, answer

ABOUT = "history"


def driven(seed: int, ticks: int = 200, **parts: object) -> Timeline:
    config = Config(seed=seed, columns=6, rows=20, vehicles=14, pedestrians=2, potholes=3)
    timeline = Timeline(config.with_parts(**parts))
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < ticks:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("seed", range(6))
def test_a_near_miss_is_a_gap_under_the_limit_and_lasts_as_long_as_it_does(seed: int) -> None:
    timeline = driven(seed, 30)
    states = list(timeline.between(0, timeline.tick + 1))
    found = near_misses(states)
    close = {
        (call.tick, call.id)
        for pair in pairwise(states)
        for call in closest_calls(pair)
        if call.gap_m < NEAR_MISS_M
    }
    assert {(call.tick, call.id) for call in found} <= close
    begun = {(tick, id) for tick, id in close if (tick - 1, id) not in close}
    assert len(found) == len(begun)
    assert [call.tick for call in found] == sorted(call.tick for call in found)


@pytest.mark.parametrize("code", NARRATORS)
def test_near_misses_are_counted_first_and_told_with_what_counts(code: str) -> None:
    yes, _ = YES_NO[code]
    counts = set()
    for seed in range(6):
        timeline = driven(seed, 30)
        told = answer(timeline, code, about=ABOUT, what="near_misses")
        count = len(told["near_misses"])
        counts.add(count > 0)
        assert str(NEAR_MISS_M).replace(".", "." if code == "en" else ",") in told["text"]
        if count:
            assert told["text"].startswith(f"{count} ")
            assert answer(timeline, code, "whether", about=ABOUT, what="near_misses")["text"].startswith(yes)
        last = answer(timeline, code, about=ABOUT, what="near_misses", ticks=1)["near_misses"]
        assert all(each["tick"] == told["last"] - 1 for each in last)
        people = answer(timeline, code, about=ABOUT, what="near_misses", kind="pedestrian")
        assert all(each["id"].startswith("pedestrian") for each in people["near_misses"])
        assert answer(timeline, code, about=ABOUT, what="near_misses", kind="pothole")["near_misses"] == []
    assert True in counts


@pytest.mark.parametrize("code", NARRATORS)
def test_the_latest_move_is_judged_by_default_and_a_crash_is_one(code: str) -> None:
    crashed = 0
    for seed in range(12):
        timeline = driven(seed, 60, sensor="radar", weather="rain", planner="priority")
        world = timeline.state.world
        told = answer(timeline, code, about=ABOUT, what="move_risk")
        assert told["at_tick"] == (timeline.tick if world.ended is None else world.ended) - 1
        assert told["crashed"] is (world.outcome is Outcome.CRASH)
        crashed += told["crashed"]
        assert answer(timeline, code, about=ABOUT, what="move_risk", tick=0)["at_tick"] == 0
        assert answer(timeline, code, about=ABOUT, what="move_risk", ticks=2)["at_tick"] == timeline.tick - 2
    assert crashed


def test_a_move_that_was_not_made_has_no_risk() -> None:
    timeline = driven(1, 3)
    for tick, code in ((3, "not_yet"), (9, "no_such_tick")):
        with pytest.raises(QuestionError, match=code):
            move_risk(timeline, tick)
    with pytest.raises(QuestionError, match="nothing_yet"):
        move_risk(driven(1, 0))


@pytest.mark.parametrize("seed", range(4))
def test_figures_add_up(seed: int) -> None:
    timeline = driven(seed)
    drive = drive_so_far(timeline)
    counted = timeline.state.metrics
    assert drive.counted.distance_m == counted.distance_m
    assert drive.ticks == counted.steps
    assert drive.done + drive.left == drive.rows
    if drive.half is not None:
        row = [timeline.at(drive.half - back).world.av // 6 for back in (0, 1)]
        assert 2 * row[0] <= drive.rows < 2 * row[1]
    best = best_time(timeline)
    assert best.known
    assert not best.changed
    if drive.outcome is Outcome.SUCCESS:
        assert best.ticks is not None
        assert drive.rows <= best.ticks <= drive.ticks


@pytest.mark.parametrize("code", NARRATORS)
def test_figures_are_told_at_any_moment(code: str) -> None:
    for seed in range(6):
        for ticks in (0, 1, 9, 200):
            timeline = driven(seed, ticks, attentive=(1.0, 0.5)[seed % 2])
            for what in ("average_speed", "way_share", "best_time", "straight_line"):
                answer(timeline, code, about=ABOUT, what=what)
            half = answer(timeline, code, "half", about=ABOUT, what="way_share")
            if ticks == 200 and half["half_at"] is not None:
                assert f" {half['half_at']}" in half["text"].split(".")[0]


def test_the_average_of_a_drive_is_of_that_drive_alone() -> None:
    timeline = driven(1)
    first = timeline.state.world.ended
    while timeline.state.world.episode == 1 or timeline.state.world.episode_tick < 4:
        timeline.advance()
    told = answer(timeline, "en", about=ABOUT, what="average_speed")
    assert told["last"] - told["first"] == 4
    assert first is not None
    assert told["first"] > first
