"""Whether a move was needed, against the move made in its stead; and what is counted over a drive."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain.alternatives import after_move
from sim.explain.coming_turn import LANE_CHANGES, STOPS, coming_turn
from sim.explain.necessity import Need, necessity
from sim.explain.occurrences import Event, Query, occurrences
from sim.explain.question_error import QuestionError
from sim.explain.tight_moments import tight_moments
from sim.session.timeline import Timeline
from sim.types import Move, Outcome


def driven(ticks: int, **parts: object) -> Timeline:
    road = Config(columns=6, rows=14, potholes=14, vehicles=12, pedestrians=4, attentive=0.0)
    timeline = Timeline(road.with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def test_a_move_is_needed_where_straight_on_would_have_met_something() -> None:
    found = set()
    for seed in range(10):
        timeline = driven(30, seed=seed, planner="astar" if seed % 2 else "rules")
        for tick in range(timeline.tick):
            decision = timeline.decision(tick)
            if decision is None or not decision.move.offset[0]:
                continue
            judged = necessity(timeline, tick)
            state = timeline.at(tick)
            met = after_move(state, Move.FORWARD).world
            assert (judged.need in (Need.SHUT, Need.BOTH)) == (met.outcome is Outcome.CRASH)
            if judged.need is Need.SHUT:
                assert met.cause is not None
                assert set(judged.hit) <= set(met.cause.ids)
                assert judged.needed
            for other in judged.free:
                assert after_move(state, other).world.outcome is not Outcome.CRASH
            found.add(judged.need)
    assert Need.SHUT in found
    assert found & {Need.NOT, Need.LATER}


def test_what_the_other_move_costs_is_the_difference_of_the_best_ways() -> None:
    judged = [
        necessity(timeline, decision.tick)
        for seed in range(8)
        for timeline in (driven(30, seed=seed, planner="astar"),)
        for tick in range(timeline.tick)
        if (decision := timeline.decision(tick)) is not None and decision.move.offset[0]
    ]
    free = [each for each in judged if each.need in (Need.LATER, Need.NOT) and each.stakes is not None]
    assert free
    for each in free:
        assert each.stakes is not None
        lost = each.stakes.ticks_lost
        assert (each.need is Need.LATER) == (lost is not None and lost > 0)
        assert not each.needed


def test_a_wait_is_judged_by_all_of_its_ticks() -> None:
    seen = 0
    for seed in range(12):
        timeline = driven(30, seed=seed, planner="rules")
        for stop in occurrences(timeline, Query(event=Event.STOP)).found:
            judged = necessity(timeline, stop.tick, Move.STAY)
            shut = [
                tick
                for tick in range(stop.tick, stop.tick + stop.ticks)
                if after_move(timeline.at(tick), Move.FORWARD).world.outcome is Outcome.CRASH
            ]
            assert judged.stood == stop.ticks
            assert judged.shut == len(shut)
            assert (judged.need in (Need.SHUT, Need.BOTH)) == bool(shut)
            seen += 1
    assert seen


def test_what_was_not_made_is_not_judged() -> None:
    timeline = driven(4, seed=1, potholes=0, vehicles=0, pedestrians=0)
    with pytest.raises(QuestionError, match="no_detour"):
        necessity(timeline)
    with pytest.raises(QuestionError, match="never_made"):
        necessity(timeline, move=Move.STAY)
    with pytest.raises(QuestionError, match="not_that_move"):
        necessity(timeline, 2, Move.LEFT)
    assert necessity(timeline, 2).foil is Move.STAY


def test_the_seconds_of_all_lanes_are_those_of_the_drive() -> None:
    timeline = driven(12, seed=3, planner="astar")
    found = occurrences(timeline, Query(event=Event.DRIVE))
    assert sum(ticks for _, ticks in found.lanes) == found.driven
    counts = [
        timeline.at(tick).world.road.cell(timeline.at(tick).world.av)[0] + 1 for tick in range(found.driven)
    ]
    assert dict(found.lanes) == {lane: counts.count(lane) for lane in set(counts)}
    assert [ticks for _, ticks in found.lanes] == sorted((ticks for _, ticks in found.lanes), reverse=True)
    assert occurrences(driven(0, seed=3), Query(event=Event.DRIVE)).lanes == ()


def test_tight_moments_are_those_with_one_move_left() -> None:
    one = none = 0
    for seed in range(8):
        timeline = driven(30, seed=seed, planner="rules")
        found = tight_moments(timeline)
        for risk in (*found.one, *found.none):
            state = timeline.at(risk.tick)
            free = [
                move
                for move in Move
                if state.config.ego_dynamics(state.world.road).target(state.world.av, move) is not None
                and after_move(state, move).world.outcome is not Outcome.CRASH
            ]
            assert len(free) == (1 if risk in found.one else 0)
        one, none = one + len(found.one), none + len(found.none)
    assert one


@pytest.mark.parametrize("moves", [STOPS, LANE_CHANGES])
def test_the_next_turn_is_the_one_that_comes(moves: tuple[Move, ...]) -> None:
    found = set()
    for seed in range(10):
        timeline = driven(2, seed=seed, planner="rules")
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        coming = coming_turn(timeline, moves)
        start = timeline.tick
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        real = [
            tick
            for tick in range(start, timeline.tick)
            if (decision := timeline.decision(tick)) is not None and decision.move in moves
        ]
        assert coming.after == (real[0] - start if real else None)
        found.add(coming.after is None)
    assert False in found
    with pytest.raises(QuestionError, match="nothing_ahead"):
        coming_turn(timeline, moves)
