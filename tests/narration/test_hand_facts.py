"""What is told of driving by hand and of luck is what the simulator does, in both languages."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.narration.answers import FACTS_OF_DRIVING_BY_HAND
from service.sessions.facts import Asked
from sim.actions import Drive, SetMode
from sim.config import Config
from sim.decide import decide
from sim.explain.blame import Fault, blame
from sim.explain.luck import luck
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome
from tests.narration.test_by_hand import NARRATORS, YES_NO, answer
from tests.narration.test_drive_figures import driven
from tests.sim.explain.test_hand_beside import by_hand


@pytest.mark.parametrize("code", NARRATORS)
def test_facts_are_told_in_every_state_of_a_session(code: str) -> None:
    sessions = [
        by_hand(1, 6),
        by_hand(2, 90),
        driven(1, 3, sensor="camera", weather="fog"),
        driven(2),
    ]
    for timeline in sessions:
        for what in FACTS_OF_DRIVING_BY_HAND:
            for supposes in (None, "drawn", "sensor"):
                told = answer(timeline, code, supposes, about="world", what=what)
                assert told["what"] == what


@pytest.mark.parametrize("code", NARRATORS)
def test_time_runs_on_by_the_clock_of_the_session(code: str) -> None:
    ask = Ask(about="world", what="hand_time")
    timeline = by_hand(1, 6)

    def told(**clock: Any) -> str:
        return str(NARRATORS[code].answer(Asked(ask, timeline, **clock))["text"])

    assert told(paused=True) != told()
    half = f" {timeline.state.config.step_seconds / 2:g} s".replace(".", "." if code == "en" else ",")
    assert half in told(playback_speed=2)
    assert half not in told()
    assert " s" not in told(playback_speed="max").split(".")[0].split(":")[1][:25]


def test_without_a_key_it_stays_and_the_planner_is_asked_all_the_same() -> None:
    timeline = by_hand(3, 5, moves=(Move.STAY,))
    decision = decide(timeline.state)
    assert decision is not None
    assert (decision.move, decision.asked) == (Move.STAY, Move.STAY)
    alone = decide(timeline.state.with_ego(mode=Mode.AUTO, queue=()))
    assert alone is not None
    assert {each.move: each.reason for each in decision.options} == {
        each.move: each.reason for each in alone.options
    }


def test_a_crash_while_a_person_stands_is_the_persons() -> None:
    found = 0
    for seed in range(40):
        config = Config(seed=seed, columns=4, rows=12, vehicles=14, potholes=0, attentive=0.0)
        timeline = Timeline(config)
        timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
        for sequence in range(2, 12):
            if timeline.state.world.outcome is not Outcome.RUNNING:
                break
            if sequence < 4:
                timeline.apply(sequence, [Drive(move=Move.FORWARD)])
            timeline.advance()
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        judged = blame(timeline)
        if judged.decision.held_back:
            continue
        assert judged.decision.move is Move.STAY  # the perfect sensor holds back all else
        assert judged.fault is Fault.PERSON
        found += 1
    assert found


@pytest.mark.parametrize("code", NARRATORS)
def test_where_nothing_is_left_to_chance_luck_is_denied(code: str) -> None:
    _, no = YES_NO[code]
    told = answer(driven(1), code, about="history", what="luck")
    assert told["text"].startswith(no)
    assert told["outcomes"] == []
    assert told["left_to_chance"] == {"reactions": False, "sensing": False, "slips": False}


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize(
    "parts",
    [{"sensor": "radar", "weather": "rain"}, {"courtesy": 0.5}, {"weather": "snow", "slip_probability": 0.3}],
)
def test_luck_is_told_with_the_share_of_other_drives(code: str, parts: dict[str, object]) -> None:
    for seed in range(3):
        for ticks in (6, 200):
            timeline = driven(seed, ticks, **parts)
            told = answer(timeline, code, about="history", what="luck")
            assert len(told["outcomes"]) == 20
            for outcome in set(told["outcomes"]):
                assert str(told["outcomes"].count(outcome)) in told["text"]
            if timeline.state.world.outcome is not Outcome.RUNNING:
                assert Outcome.RUNNING not in told["outcomes"]


def test_other_chances_leave_the_road_and_what_was_said_as_they_are() -> None:
    timeline = by_hand(4, 12, moves=(Move.FORWARD, Move.STAY))
    assert not luck(timeline).by_chance
    with pytest.raises(QuestionError, match="nothing_yet"):
        luck(driven(1, 0, courtesy=0.5))


@pytest.mark.parametrize("code", NARRATORS)
def test_a_persons_part_is_told_with_what_was_held_back(code: str) -> None:
    held = 0
    for seed in range(12):
        timeline = by_hand(seed, (4, 30)[seed % 2])
        world = timeline.state.world
        last = timeline.tick if world.ended is None else world.ended
        for supposes in (None, "held_back", "would"):
            told = answer(timeline, code, supposes, about="history", what="hand_since")
        assert (told["since_tick"], told["moves"]) == (2, last - 2)
        assert (told["until_tick"] is None) is (world.outcome is Outcome.RUNNING)
        made = {each["tick"]: timeline.decided(timeline.at(each["tick"])) for each in told["held_back"]}
        assert all(each is not None and each.held_back for each in made.values())
        held += len(made)
        alone = decide(timeline.at(2).with_ego(mode=Mode.AUTO, queue=()))
        assert alone is not None
        assert told["planner_would"] == alone.move
    assert held
    assert "since_tick" not in answer(driven(1, 4), code, about="history", what="hand_since")


@pytest.mark.parametrize("code", NARRATORS)
def test_start_goal_and_diagonals_are_those_of_the_road(code: str) -> None:
    for ticks in (0, 5, 200):
        timeline = driven(2, ticks)
        told = answer(timeline, code, about="history", what="started")
        column, row = timeline.at(0).world.road.cell(timeline.at(0).world.av)
        assert (told["lanes"][0], told["rows"]) == (column + 1, row)
        column, row = timeline.state.world.road.cell(timeline.state.world.av)
        assert (told["lanes"][1], told["rows_left"]) == (column + 1, row)
        assert " 6 " in answer(timeline, code, about="world", what="goal")["text"]
        assert " 7" in answer(timeline, code, about="world", what="diagonal")["text"]
