"""Which of the three it is: safe whatever the others do, likely, or merely possible."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace

import pytest

from sim.config import Config
from sim.explain.assurance import Level, assurance
from sim.explain.safe_move import safe_move
from sim.explain.soon import risk_now
from sim.forecast import Forecast
from sim.search.reachability import steps_left
from sim.search.robust_reachability import guarantee
from sim.session.timeline import Timeline
from sim.types import MOVES, Move, Outcome
from sim.world import World
from tests.support.roads import road, run_on


def moments(count: int) -> Iterator[Timeline]:
    """Running sessions somewhere on their way, some of them with movers that react by chance."""
    draw = random.Random(41)
    while count:
        config = Config(
            seed=draw.randrange(10**6),
            columns=6,
            rows=14,
            potholes=draw.choice([8, 18]),
            vehicles=draw.choice([6, 14]),
            pedestrians=draw.choice([0, 4]),
            attentive=draw.choice([0.0, 0.5, 1.0]),
            courtesy=draw.choice([0.0, 0.5]),
            planner=draw.choice(["rules", "priority", "astar"]),
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(12)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING:
            count -= 1
            yield timeline


def on(world: World, **parts: object) -> Timeline:
    state = run_on(world, **parts)
    timeline = Timeline(state.config)
    timeline.state = state
    return timeline


def test_the_level_is_what_its_facts_say() -> None:
    met = set()
    for timeline in moments(40):
        state = timeline.state
        limit = steps_left(state.config, state.world.episode_tick)
        for move in MOVES:
            found = safe_move(timeline, move)
            sure = found.assurance
            assert (sure is None) is (found.then is None)
            if sure is None or found.then is None:
                continue
            met.add(sure.level)
            truth = Forecast.of_truth(state.world, state.config, 1)
            assert sure.sure == guarantee(truth, limit, first=move)
            assert (sure.level is Level.WHATEVER) is sure.sure.to_the_end
            if sure.level is Level.LIKELY:
                assert found.then.crashes <= 0.5
            if sure.level in (Level.POSSIBLE, Level.NONE):
                assert found.then.crashes > 0.5
                assert (found.open is True) is (sure.level is Level.POSSIBLE)
            if sure.may_hit:
                assert not sure.sure.ticks
    assert met == set(Level)


def test_what_can_be_hit_by_nobody_is_safe_whatever_they_do() -> None:
    world = road("......", ">.....", "......", "......", "..A...")
    found = safe_move(on(world), Move.LEFT).assurance
    assert found is not None
    assert found.level is Level.WHATEVER
    assert found.may_hit == ()


def test_a_mover_that_goes_away_makes_it_likely_and_is_named() -> None:
    """By its rules it goes on to the right; were it to turn, it would meet the ego."""
    world = road("......", "......", "...>..", "..A...", "......")
    found = safe_move(on(world), Move.FORWARD).assurance
    assert found is not None
    assert found.level is Level.LIKELY
    assert found.may_hit == ("vehicle-1",)
    assert found.sure.ticks == 0


def test_how_safe_it_is_now_is_that_of_the_best_move() -> None:
    for timeline in moments(12):
        state = timeline.state
        found = risk_now(timeline).assurance
        truth = Forecast.of_truth(state.world, state.config, 1)
        assert found.sure == guarantee(truth, steps_left(state.config, state.world.episode_tick))
        assert found.may_hit == ()


def test_whether_a_way_leads_on_is_asked_only_where_it_decides() -> None:
    state = run_on(road("......", "......", "...>..", "..A...", "......"))

    def unasked() -> bool:
        raise AssertionError

    assert assurance(state, 0.2, unasked, move=Move.FORWARD).level is Level.LIKELY
    assert assurance(state, 0.9, lambda: True, move=Move.FORWARD).level is Level.POSSIBLE
    assert assurance(state, 0.9, lambda: None, move=Move.FORWARD).level is Level.NONE


@pytest.mark.parametrize("courtesy", [0.0, 0.5, 1.0])
def test_chance_has_no_part_in_what_holds_whatever_they_do(courtesy: float) -> None:
    for timeline in moments(8):
        state = timeline.state
        config = state.config.with_parts(courtesy=courtesy, attentive=courtesy)
        found = assurance(replace(state, config=config), 0.0, lambda: True)
        assert found.sure == assurance(state, 0.0, lambda: True).sure
