"""Answers about the course of a drive and the space to come: direct, brief, measured, in both languages."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest

from sim.actions import SetMode
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Kind, Mode, Outcome
from tests.narration.test_barred_rows import NARRATORS, YES_NO, told

PAST = (
    *("last_detected", "least_ttc", "smoothness", "reversals", "nearest_goal"),
    *("here_since", "not_advanced", "story", "mishaps"),
)


def driven(seed: int, ticks: int = 80, **more: object) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=16, pedestrians=3, potholes=4, seed=seed)
    timeline = Timeline(config.with_parts(**more))
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("ticks", [0, 6, 80])
def test_each_is_brief_and_in_sentences(code: str, ticks: int) -> None:
    for seed, sensor in ((0, "perfect"), (1, "camera"), (3, "fusion"), (5, "radar")):
        timeline = driven(seed, ticks, sensor=sensor, courtesy=0.5 if seed > 2 else 0.0)
        for what in PAST:
            told(timeline, code, about="history", what=what)
        told(timeline, code, "lane", about="history", what="here_since")
        told(timeline, code, about="history", what="places_before")
        told(timeline, code, about="history", what="places_before", ticks=1)
        for which in ({"kind": "vehicle", "nearest": True}, {"kind": "pothole", "nearest": True}):
            told(timeline, code, about="history", what="last_detected", which=which_of(which))
            told(timeline, code, about="history", what="places_before", which=which_of(which))
        for kind in (None, "vehicle", "pedestrian", "pothole"):
            told(timeline, code, about="outlook", what="others_next", kind=kind)
        for move in ("left", "right", "forward"):
            told(timeline, code, about="outlook", what="stays_free", move=move)
            told(timeline, code, about="outlook", what="stays_free", move=move, ticks=1)
        for then in ({"ticks": 3}, {"seconds": 2.0}, {"tick": 2}, {"tick": 120}):
            told(timeline, code, about="outlook", what="place_then", **then)
        for where in ("lanes fullest", "lanes densest"):
            told(timeline, code, where, about="scene", kind="vehicle")


def which_of(parts: dict[str, object]) -> object:
    from service.actions.action import Which

    return Which(**parts)  # type: ignore[arg-type]


@pytest.mark.parametrize("code", NARRATORS)
def test_yes_and_no_are_what_was_found(code: str) -> None:
    yes, no = YES_NO[code]
    for seed in range(6):
        timeline = driven(seed, 8 if seed % 2 else 80)
        answer = told(timeline, code, about="history", what="reversals")
        assert str(answer["text"]).startswith(yes if answer["reversals"] else no)
        free = told(timeline, code, about="outlook", what="stays_free", move="forward")
        if "free_for" in free:
            stays = free["taken_now"] is free["comes"] is free["hit_by"] is None
            assert str(free["text"]).startswith(yes if stays else no)


def test_what_others_do_next_is_what_they_then_do() -> None:
    moved = 0
    for seed in range(6):
        timeline = driven(seed, 5, courtesy=0.5 if seed % 2 else 0.0)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        answer = told(timeline, "en", about="outlook", what="others_next", kind="vehicle")
        before = timeline.state
        timeline.advance()
        for each in answer["others"]:  # type: ignore[attr-defined]
            was, now = before.world.find(each["id"]), timeline.state.world.find(each["id"])
            assert was is not None
            assert now is not None
            assert was.kind is Kind.VEHICLE
            across = now.cell[0] - was.cell[0]
            assert {-1: "left", 0: "stay", 1: "right"}[across] == each["move"]
            moved += across != 0
    assert moved > 5


def test_events_are_told_in_their_order() -> None:
    for seed in range(6):
        for what in ("story", "mishaps"):
            answer = told(driven(seed), "en", about="history", what=what)
            ticks = [each["tick"] for each in answer["events"]]  # type: ignore[attr-defined]
            assert all(one <= other for one, other in pairwise(ticks))
            if what == "story":
                said = [int(each) for each in re.findall(r"(?:^Tick |; )(\d+):", str(answer["text"]))]
                assert said == sorted(said)
                assert said[-1] == answer["last"]


def test_where_it_will_be_while_a_person_drives_is_told_of_the_planner() -> None:
    timeline = driven(0, 2)
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    answer = told(timeline, "en", about="outlook", what="place_then", ticks=2)
    assert answer["text"].startswith("You are driving; suppose I take over now.")
    past = told(timeline, "en", about="outlook", what="place_then", tick=1)
    assert past["text"].startswith("At tick 1")


def test_a_drive_that_ends_at_the_very_tick_is_not_over_before_it() -> None:
    timeline = Timeline(Config(columns=3, rows=6, vehicles=0, pedestrians=0, potholes=0))
    answer = told(timeline, "en", about="outlook", what="place_then", tick=5)
    assert answer["lane"] is None
    assert "by tick 5 I arrive" in str(answer["text"])
    assert told(timeline, "en", about="outlook", what="place_then", tick=4)["row"] == 1
