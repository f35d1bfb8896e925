"""Which decision a question means."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain import QuestionError, why, why_not
from sim.session.timeline import Timeline
from sim.types import Move

pytestmark = pytest.mark.xdist_group("a run of 400 ticks")


@pytest.fixture(scope="module")
def timeline() -> Timeline:
    """A run of 400 ticks over several episodes."""
    timeline = Timeline(Config(seed=5, potholes=20))
    for _ in range(400):
        timeline.advance()
    return timeline


@pytest.fixture(scope="module")
def decisions(timeline: Timeline) -> dict[int, Move]:
    """The move of every tick that had one."""
    found = {tick: timeline.decision(tick) for tick in range(timeline.tick)}
    return {tick: decision.move for tick, decision in found.items() if decision is not None}


def test_without_more_the_latest_decision_is_meant(timeline: Timeline, decisions: dict[int, Move]) -> None:
    assert why(timeline).decision.tick == max(decisions)


def test_a_move_means_the_latest_such_decision(timeline: Timeline, decisions: dict[int, Move]) -> None:
    latest = max(tick for tick, move in decisions.items() if move in (Move.LEFT, Move.FORWARD_LEFT))
    assert why(timeline, move=Move.LEFT).decision.tick == latest


def test_a_stop_means_the_latest_of_this_drive(timeline: Timeline, decisions: dict[int, Move]) -> None:
    latest = max(tick for tick, move in decisions.items() if move is Move.STAY)
    just_stopped, next_drive = timeline.copy(), timeline.copy()
    just_stopped.rewind(latest + 1)
    assert why(just_stopped, move=Move.STAY).decision.tick == latest
    began = timeline.at(latest).world.episode_start
    begins = min(tick for tick in decisions if timeline.at(tick).world.episode_start > began)
    next_drive.rewind(begins + 1)
    with pytest.raises(QuestionError) as caught:
        why(next_drive, move=Move.STAY)
    assert code(caught) == "never_made"


def test_every_past_decision_can_be_asked_about(timeline: Timeline, decisions: dict[int, Move]) -> None:
    for tick, move in decisions.items():
        explanation = why(timeline, tick=tick)
        assert (explanation.decision.tick, explanation.decision.move) == (tick, move)


def code(error: pytest.ExceptionInfo[QuestionError]) -> str:
    return error.value.code


def test_what_is_not_so_is_said(timeline: Timeline) -> None:
    ended = next(tick for tick in range(timeline.tick) if timeline.decision(tick) is None)
    for expected, question in {
        "no_such_tick": lambda: why(timeline, tick=5000),
        "not_yet": lambda: why(timeline, tick=timeline.tick),
        "result_stood": lambda: why_not(timeline, Move.LEFT, tick=ended),
        "nothing_yet": lambda: why(Timeline(Config())),
        "never_made": lambda: why(Timeline(Config()), move=Move.STAY),
    }.items():
        with pytest.raises(QuestionError) as caught:
            question()
        assert code(caught) == expected


def test_a_tick_with_another_move_is_told_apart(timeline: Timeline, decisions: dict[int, Move]) -> None:
    tick = next(tick for tick, move in decisions.items() if move is Move.FORWARD)
    with pytest.raises(QuestionError) as caught:
        why(timeline, tick=tick, move=Move.STAY)
    assert code(caught) == "not_that_move"
