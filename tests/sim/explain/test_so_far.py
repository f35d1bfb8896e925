"""The drive up to now with something otherwise, and one thing replaced at a time, beside sessions run so."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from random import Random

import pytest

from sim.actions import Drive, SetMode
from sim.config import Config
from sim.explain.expectation import Entry, expectation
from sim.explain.question_error import QuestionError
from sim.explain.single_factors import FACTORS, single_factors
from sim.explain.so_far import so_far
from sim.explain.unsafe_moves import latest_by_hand, unsafe_moves
from sim.perceive import sensor_named
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome
from tests.support.two_egos import drawn

SEEDS = range(14)
VARIED: tuple[dict[str, str | float], ...] = (
    {"planner": "astar"},
    {"sensor": "perfect"},
    {"weather": "clear", "time_of_day": "day"},
    {"sensor": "lidar", "planner": "bfs"},
    {"planner": "priority"},
    {"courtesy": 0},
    {"sensor_noise": 0},
)


@cache
def driven(seed: int, ticks: int = 12) -> Timeline:
    config = Config(columns=5, rows=18, vehicles=14, pedestrians=3, potholes=4, barriers=3, seed=seed)
    sensor = ("radar", "camera", "perfect")[seed % 3]
    timeline = Timeline(
        config.with_parts(sensor=sensor, weather="rain", planner="priority", courtesy=seed % 2 / 2)
    )
    while timeline.tick < ticks and timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def failed() -> list[Timeline]:
    found = [driven(seed, 200) for seed in SEEDS]
    return [each for each in found if each.state.world.outcome in (Outcome.CRASH, Outcome.STUCK)]


def by_hand(seed: int) -> Timeline:
    timeline = Timeline(Config(columns=5, rows=18, vehicles=14, pedestrians=3, potholes=8, seed=seed))
    timeline.advance()
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    moves = (Move.FORWARD, Move.RIGHT, Move.FORWARD, Move.LEFT, Move.FORWARD, Move.RIGHT)
    for sequence, move in enumerate(moves, 2):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.apply(sequence, [Drive(move=move)])
        timeline.advance()
    return timeline


def fresh(
    timeline: Timeline, varied: Mapping[str, str | float], end: int | None
) -> list[tuple[Move | None, SimState]]:
    """The moves and states of a session that begins so, to its end or to a tick."""
    state, found = SimState.start(timeline.config.with_parts(**varied)), []
    while state.world.outcome is Outcome.RUNNING and (end is None or state.world.tick < end):
        tick = step(state)
        state = tick.state
        found.append((None if tick.decision is None else tick.decision.move, state))
    return found


@pytest.mark.parametrize("varied", VARIED, ids=str)
def test_the_other_drive_is_what_a_session_so_begun_comes_to(varied: dict[str, str | float]) -> None:
    for seed in SEEDS:
        timeline = driven(seed)
        world = timeline.state.world
        found = so_far(timeline, varied)
        other = fresh(timeline, varied, None if world.ended is not None else timeline.tick)
        assert (found.outcome, found.tick) == (other[-1][1].world.outcome, other[-1][1].world.tick)
        real = [timeline.decided(each) for each in timeline.between(0, found.end)]
        pairs = zip(real, other, strict=False)
        first = next((at for at, (one, two) in enumerate(pairs) if one and one.move is not two[0]), None)
        assert first == (None if found.differs is None else found.differs.tick)
        assert found.same is (first is None and len(other) >= len(real))


def test_nothing_otherwise_is_the_same() -> None:
    for seed in SEEDS:
        found = so_far(driven(seed), {"planner": "priority", "weather": "rain"})
        assert found.same
        assert found.rows == 0


def test_before_the_first_move_nothing_is_told() -> None:
    with pytest.raises(QuestionError, match="nothing_yet"):
        so_far(Timeline(Config()), {"planner": "astar"})
    with pytest.raises(QuestionError, match="no_such_planner"):
        so_far(driven(0), {"planner": "nobody"})


def test_moves_of_a_person_are_made_again() -> None:
    for seed in range(4):
        timeline = by_hand(seed)
        found = so_far(timeline, {"planner": "astar"})
        assert found.by_hand
        assert found.differs is None or found.differs.tick == 0  # the tick before the person drove


def test_each_factor_is_what_a_session_so_begun_comes_to() -> None:
    assert len(failed()) >= 6
    helped = set()
    for timeline in failed():
        found = single_factors(timeline)
        assert (found.outcome, found.tick) == (timeline.state.world.outcome, timeline.state.world.ended)
        for each in found.found:
            varied = {"weather": "clear", "time_of_day": "day"}
            varied = varied if each.factor == "weather" else {each.factor: each.value}
            other = fresh(timeline, varied, None)
            assert (each.outcome, each.ticks) == (other[-1][1].world.outcome, len(other))
        assert bool(found.of("sensor")) is not sensor_named(timeline.config.sensor).faithful
        helped |= {factor for factor in FACTORS if found.helps(factor)}
    assert {"sensor", "planner"} <= helped


def test_a_drive_that_has_not_failed_hangs_on_nothing() -> None:
    with pytest.raises(QuestionError, match="not_failed"):
        single_factors(driven(1, 3))


def test_what_was_expected_is_beside_what_was_done() -> None:
    entries = set()
    for seed in range(30):
        timeline = driven(seed, 200)
        if timeline.state.world.outcome is not Outcome.CRASH:
            continue
        try:
            found = expectation(timeline)
        except QuestionError:
            continue  # only another ego was hit, or the crash was in no tick of the record
        entries.add(found.entry)
        before, after = timeline.at(found.tick).world, timeline.at(found.tick + 1).world
        for each in found.found:
            was, went = before.find(each.id), after.find(each.id)
            assert was is not None
            assert each.was == was.cell
            assert went is None or each.went == went.cell
            assert each.detected or each.expected is None
            if found.entry is Entry.ELSEWHERE:
                assert each.expected != each.went or not each.moves
    assert {Entry.UNSEEN, Entry.ELSEWHERE} <= entries


def test_unsafe_moves_are_those_held_back_or_made_into_what_was_seen() -> None:
    told = 0
    for seed in range(8):
        timeline = by_hand(seed)
        found = unsafe_moves(timeline)
        decisions = [timeline.decided(each) for each in timeline.between(0, timeline.tick)]
        asked = [each for each in decisions if each is not None and each.asked is not None]
        assert found.by_hand == len(asked)
        blocked = [each.tick for each in asked if each.option(each.asked or each.move).reason.blocks]
        assert [each.tick for each in found.found] == blocked
        assert latest_by_hand(timeline) == asked[-1].tick
        told += len(blocked)
    assert told
    assert unsafe_moves(driven(0)).by_hand == 0
    assert latest_by_hand(driven(0)) is None


def test_with_several_autonomous_vehicles_it_is_not_told() -> None:
    state = drawn(Random(4), "rules")
    timeline = Timeline(state.config, state)
    for _ in range(3):
        timeline.advance()
    with pytest.raises(QuestionError) as refused:
        so_far(timeline, {"planner": "astar"})
    assert refused.value.code == "several_drive"
