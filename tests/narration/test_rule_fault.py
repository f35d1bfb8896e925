"""Answers about rules in a crash, about whose one would be now, and about the last moves one by one."""

from __future__ import annotations

from functools import cache

import pytest

from service.actions import Ask
from service.narration.move_reasons import MOST_MOVES
from service.sessions.facts import Asked
from sim.actions import Drive, SetMode
from sim.config import Config
from sim.explain.blame import Fault
from sim.explain.rule_fault import rule_fault
from sim.session.timeline import Timeline
from sim.transition import step
from sim.types import Mode, Move, Outcome
from tests.narration.test_barred_rows import NARRATORS, YES_NO, told

SEEDS = range(24)


@cache
def driven(seed: int, ticks: int = 60) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=14, pedestrians=3, potholes=4, barriers=3, seed=seed)
    sensor = ("perfect", "radar", "camera")[seed % 3]
    timeline = Timeline(
        config.with_parts(sensor=sensor, weather="rain", planner=("priority", "rules")[seed % 2])
    )
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def crashed() -> list[Timeline]:
    return [each for seed in SEEDS if (each := driven(seed)).state.world.outcome is Outcome.CRASH]


def test_other_planners_are_driven_from_the_last_way_out() -> None:
    assert len(crashed()) >= 3
    for timeline in crashed():
        found = rule_fault(timeline)
        assert found.since <= found.blame.state.world.tick
        assert not set(found.kept_clear) & set(found.crashed)
        for each in found.others:
            state = timeline.at(found.since).with_ego(None, planner=each.planner)
            for _ in range(400):
                if state.world.outcome is not Outcome.RUNNING:
                    break
                state = step(state).state
            if state.config.certain and each.foresight.told:
                assert (state.world.outcome is Outcome.CRASH) is (each.planner in found.crashed)


@pytest.mark.parametrize("code", NARRATORS)
def test_the_part_of_the_rules_is_yes_or_no_by_the_fault(code: str) -> None:
    yes, no = YES_NO[code]
    for timeline in crashed():
        answer = told(timeline, code, about="blame", what="rules")
        fault = answer["fault"]
        if fault in (Fault.EGO, Fault.SHARED):
            assert str(answer["text"]).startswith(yes)
        elif fault != Fault.UNKNOWN:
            assert str(answer["text"]).startswith(no)
        assert str(told(timeline, code, about="blame", what="bug")["text"]).startswith(no)


@pytest.mark.parametrize("code", NARRATORS)
def test_without_a_crash_that_is_the_answer(code: str) -> None:
    for what in ("rules", "bug"):
        assert "since" not in told(driven(1, 2), code, about="blame", what=what)


@pytest.mark.parametrize("code", NARRATORS)
def test_whose_a_crash_would_be_is_told_of_who_drives(code: str) -> None:
    timeline = driven(0, 2).copy()
    assert told(timeline, code, about="outlook", what="liable")["by_hand"] is False
    timeline.apply(1, (SetMode(mode=Mode.MANUAL), Drive(move=Move.STAY)))
    assert told(timeline, code, about="outlook", what="liable")["by_hand"] is True
    assert "by_hand" not in told(crashed()[0], code, about="outlook", what="liable")


@pytest.mark.parametrize("code", NARRATORS)
def test_each_of_the_last_moves_has_its_reason(code: str) -> None:
    for seed in (1, 3, 4):
        timeline = driven(seed)
        stop = timeline.state.world.ended or timeline.tick
        for ticks in (1, 3, 40):
            answer = NARRATORS[code].answer(
                Asked(Ask(about="history", what="explained", ticks=ticks), timeline)
            )
            moves = answer["moves"]
            assert [each["tick"] for each in moves] == list(
                range(max(0, stop - min(ticks, MOST_MOVES)), stop)
            )
            for each in moves:
                decision = timeline.decision(each["tick"])
                assert decision is not None
                assert each["move"] is decision.move
                assert each["text"] in answer["text"]
    begun = NARRATORS[code].answer(Asked(Ask(about="history", what="explained"), driven(0, 0)))
    assert "moves" not in begun


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize(
    "what",
    ["real_car", "general_safety", "safety_gear", "car_talk", "rule_makers", "all_lanes"],
)
def test_facts_of_this_world_are_told_in_every_situation(code: str, what: str) -> None:
    for timeline in (driven(0, 2), *crashed()[:2]):
        answer = told(timeline, code, about="world", what=what)
        if what == "all_lanes":
            assert f" {timeline.state.world.road.columns} " in str(answer["text"])
        if what == "general_safety":
            assert f"{answer['roads']:,d}".replace(",", "." if code == "de" else ",") in str(answer["text"])
