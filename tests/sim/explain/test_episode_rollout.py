"""What will come of a run is what comes of it; an end is summed up as driving it again would."""

from __future__ import annotations

import pytest

from sim.actions import Add
from sim.config import Config
from sim.episode_record import DetourReason
from sim.explain.episode_rollout import route_ahead, story
from sim.explain.summary import long_to_tell, summary
from sim.oracle import least_ticks
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Mode, Move, Outcome
from tests.support.moments import moments
from tests.support.roads import road, run_on

WALLED = run_on(road("........", "........", "...oo...", "...A...."))


def driven(state: SimState) -> list[SimState]:
    """Every state to the end of the episode."""
    runs = [state]
    while runs[-1].world.outcome is Outcome.RUNNING:
        runs.append(step(runs[-1]).state)
    return runs


def test_a_story_is_what_comes_of_it() -> None:
    for timeline in moments(60, seed=8):
        state = timeline.state
        if state.world.outcome is not Outcome.RUNNING:
            continue
        told, end = story(state), driven(state)[-1]
        assert (told.outcome, told.end, told.digest) == (
            end.world.outcome,
            end.world.tick,
            end.world.digest(),
        )
        counted = state.metrics.steps + told.driven
        assert counted == end.metrics.steps
        assert sum(told.moves().values()) == told.driven == told.ticks
        assert len(told.detours) == told.driven - told.moves()[Move.FORWARD]


def test_a_result_that_stands_is_waited_out() -> None:
    state = driven(SimState.start(Config(seed=2)))[-1]
    told = story(state)
    assert told.waited == state.config.reset_delay_ticks
    assert told.episode == 2
    assert told.ticks == told.waited + told.driven


def test_whoever_would_have_been_met_is_whom_a_detour_is_for() -> None:
    told = story(WALLED)
    first = told.detours[0]
    assert (first.move, first.sake, first.ids) == (Move.LEFT, Kind.POTHOLE, ("pothole-1",))
    assert told.outcome is Outcome.SUCCESS


def test_driven_by_hand_and_asked_for_nothing_it_stays() -> None:
    told = story(WALLED.with_ego(mode=Mode.MANUAL))
    assert told.by_hand
    assert set(told.path) == {Move.STAY}
    assert {detour.sake for detour in told.detours} == {DetourReason.YOU}
    asked = story(WALLED.with_ego(mode=Mode.MANUAL, queue=(Move.FORWARD,)))
    assert not asked.by_hand
    assert asked.held_back == (0,)


def test_a_search_on_a_very_long_road_is_cut_short() -> None:
    told = story(SimState.start(Config(rows=512, columns=12, planner="bfs", vehicles=0, potholes=0)))
    assert (told.outcome, told.driven) == (Outcome.RUNNING, 4)


@pytest.mark.parametrize("mode", Mode)
def test_the_way_ahead_is_the_way_taken(mode: Mode) -> None:
    for seed in range(20):
        state = SimState.start(Config(seed=seed, potholes=20)).with_ego(mode=mode)
        way = route_ahead(state)
        assert way.offered is (mode is Mode.MANUAL)
        runs = driven(state.with_ego(mode=Mode.AUTO))
        for number, decision in enumerate(way.decisions):
            taken = step(runs[number]).decision
            assert taken == decision
        assert len(way.decisions) == min(5, len(runs) - 1)


def test_who_gives_way_is_not_foretold() -> None:
    assert len(route_ahead(SimState.start(Config(courtesy=0.5))).decisions) == 1
    assert not route_ahead(driven(SimState.start(Config(seed=2)))[-1]).decisions


@pytest.mark.parametrize("potholes", [None, 20, 40])
def test_an_end_is_summed_up_as_driving_it_again_would(potholes: int | None) -> None:
    for seed in range(12):
        runs = driven(SimState.start(Config(seed=seed, potholes=potholes, rows=14)))
        found, (*before, end) = summary(runs[-1]), runs
        assert found.outcome is end.world.outcome
        assert found.ticks == len(before)
        assert found.waits == end.metrics.stay
        assert found.detours == end.metrics.lateral + end.metrics.diagonal
        assert found.best == least_ticks(runs[0])
        if found.outcome is Outcome.SUCCESS:
            assert found.above is not None
            assert found.above >= 0
        if found.outcome is Outcome.STUCK:
            open_at = [number for number, state in enumerate(before) if least_ticks(state) is not None]
            assert found.open_until == (open_at[-1] if open_at else None)
            assert long_to_tell(end)
        if found.outcome is Outcome.CRASH:
            assert found.open_before is (least_ticks(before[-1]) is not None)


def test_a_crash_that_could_have_been_avoided() -> None:
    crossed = run_on(road("........", "........", "........", "..>A...."))
    hit = driven(crossed.with_ego(mode=Mode.MANUAL, queue=(Move.STAY,)))[-1]
    found = summary(hit)
    assert found.outcome is Outcome.CRASH
    assert (found.free, found.open_before) == (True, True)


def test_what_is_not_certain_is_left_out() -> None:
    chance = summary(driven(SimState.start(Config(seed=3, courtesy=0.5)))[-1])
    assert not chance.certain
    assert chance.best is None
    with pytest.raises(ValueError, match="goes on"):
        summary(SimState.start(Config()))


def test_a_road_that_was_changed_on_the_way_is_not_measured_by_how_it_began() -> None:
    timeline = Timeline(Config(seed=3))
    timeline.apply(1, [Add(kind="pothole", count=3)])
    timeline.advance()
    assert not timeline.state.record.changed
    timeline.apply(2, [Add(kind="pothole", count=3)])
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    found = summary(timeline.state)
    assert (found.certain, found.best) == (False, None)
    timeline.rewrite(timeline.entries[:1], 1)
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    assert summary(timeline.state).certain
