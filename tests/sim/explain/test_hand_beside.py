"""A person's driving beside a planner's: both from one state, with what was said to both."""

from __future__ import annotations

import random

import pytest

from sim.actions import Add, Drive, SetMode, Where
from sim.config import Config
from sim.explain.hand_beside import hand_beside
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome


def by_hand(seed: int, ticks: int, *, before: int = 2, moves: tuple[Move, ...] = tuple(Move)) -> Timeline:
    """A drive that a person takes over after some ticks, with moves by chance."""
    draw = random.Random(seed)
    timeline = Timeline(Config(seed=seed, columns=6, rows=20, vehicles=8, potholes=4))
    for _ in range(before):
        timeline.advance()
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < ticks:
        timeline.apply(timeline.tick + 2, [Drive(move=draw.choice(moves))])
        timeline.advance()
    return timeline


def alone(seed: int) -> Timeline:
    timeline = Timeline(Config(seed=seed, columns=6, rows=20, vehicles=8, potholes=4))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("seed", range(8))
def test_the_planners_run_is_the_drive_that_nobody_took_over(seed: int) -> None:
    timeline, untouched = by_hand(seed, 12), alone(seed)
    if timeline.state.world.outcome is not Outcome.RUNNING:
        pytest.skip("over too soon to compare at a tick")
    found = hand_beside(timeline)
    assert (found.took, found.now, found.own) == (2, timeline.tick, True)
    ended = untouched.state.world
    assert found.other_end == (ended.outcome, ended.ended)
    there = untouched.at(min(found.now, ended.tick)).world
    assert found.other.last.world.av == there.av
    assert found.hand.last.world.digest() == timeline.state.world.digest()


def test_a_person_who_only_waits_is_behind_and_stops_once() -> None:
    timeline = by_hand(3, 8, moves=(Move.STAY,))
    found = hand_beside(timeline)
    assert (found.hand.rows, found.hand.stops, found.hand.changes) == (0, 1, 0)
    assert found.progress == -1
    assert found.other.rows > 0


def test_what_was_said_meanwhile_is_said_to_the_planner_as_well() -> None:
    timeline = by_hand(3, 4, moves=(Move.STAY,))
    before = hand_beside(timeline).other.last.world.counts()
    timeline.apply(90, [Add(kind="barrier", count=1, where=Where(row=0))])
    timeline.apply(91, [Drive(move=Move.STAY)])
    timeline.advance()
    after = hand_beside(timeline).other.last.world.counts()
    assert sum(after.values()) == sum(before.values()) + 1


def test_another_planner_is_followed_by_its_name() -> None:
    timeline = by_hand(5, 8, moves=(Move.STAY, Move.FORWARD))
    own, other = hand_beside(timeline), hand_beside(timeline, "dijkstra")
    assert (own.own, other.own) == (True, False)
    assert other.planner == "dijkstra"
    assert other.hand.rows == own.hand.rows
    with pytest.raises(QuestionError, match="no_such_planner"):
        hand_beside(timeline, "nobody")


def test_where_nobody_drove_there_is_nothing_to_compare() -> None:
    with pytest.raises(QuestionError, match="not_by_hand"):
        hand_beside(alone(1))


@pytest.mark.parametrize("seed", range(6))
def test_signs_follow_the_figures(seed: int) -> None:
    found = hand_beside(by_hand(seed, 40))
    hand, other = found.hand, found.other
    assert (found.calm > 0) == (hand.stops + hand.changes < other.stops + other.changes)
    if Outcome.CRASH not in (hand.outcome, other.outcome) and hand.rows_left != other.rows_left:
        assert (found.progress > 0) == (hand.rows_left < other.rows_left)
    if None not in (hand.gap_m, other.gap_m) and Outcome.CRASH not in (hand.outcome, other.outcome):
        assert (found.clearance > 0) == (hand.gap_m > other.gap_m)  # type: ignore[operator]
