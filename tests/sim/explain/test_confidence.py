"""How sure it is holds: against futures run by another way, and against what really came."""

from __future__ import annotations

import random
from dataclasses import replace
from math import sqrt

import pytest

from sim.config import Config
from sim.explain import QuestionError
from sim.explain import futures as module
from sim.explain.confidence import Confidence, Method, confidence
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.statistics import wilson
from sim.transition import step
from sim.types import Mode, Move, Outcome
from tests.support.moments import moments
from tests.support.roads import road, run_on
from tools import confidence_calibration as calibration


def of(state: SimState) -> Confidence:
    timeline = Timeline(state.config)
    timeline.state = state
    return confidence(timeline)


def ends_under_other_seeds(state: SimState, seeds: int) -> list[tuple[Outcome, int]]:
    """Ends by the session's own ticks: the coming tick as it is drawn, later ones by other seeds."""
    ends = []
    for seed in range(1, seeds + 1):
        future = step(state).state
        future = replace(future, config=state.config.with_parts(seed=seed))
        while future.world.outcome is Outcome.RUNNING:
            future = step(future).state
        ends.append((future.world.outcome, future.world.tick - state.world.tick))
    return ends


def test_with_nothing_left_to_chance_the_one_future_is_told() -> None:
    for timeline in moments(60, seed=1):
        state = timeline.state
        if state.config.courtesy or state.world.outcome is not Outcome.RUNNING:
            continue
        found = confidence(timeline)
        ((outcome, ticks),) = set(ends_under_other_seeds(state, 1))
        assert found.method is Method.ONE_RUN
        assert not found.chance
        assert found.arrives == found.low == found.high == float(outcome is Outcome.SUCCESS)
        if found.shut_off:
            assert outcome is not Outcome.SUCCESS
        else:
            assert found.end_ticks == (ticks, ticks)
            assert (found.crashes, found.stuck) == (outcome is Outcome.CRASH, outcome is Outcome.STUCK)


@pytest.mark.parametrize("planner", ["priority", "bfs"])
def test_a_share_agrees_with_futures_run_under_other_seeds(planner: str) -> None:
    draw = random.Random(planner)
    looked_at = open_cases = 0
    while looked_at < 60:
        config = calibration.drawn_config(draw)
        if config.rows > 8:
            continue
        timeline = Timeline(config.with_parts(planner=planner))
        found = confidence(timeline)
        if found.method is Method.ONE_RUN:
            continue
        looked_at += 1
        ends = ends_under_other_seeds(timeline.state, 40)
        share = sum(outcome is Outcome.SUCCESS for outcome, _ in ends) / len(ends)
        if found.method is Method.ALL_FUTURES and found.arrives in (0.0, 1.0):
            assert share == found.arrives
        else:
            open_cases += 1
            error = sqrt(found.arrives * (1 - found.arrives) / 40) + (found.high - found.low) / 2
            assert abs(share - found.arrives) <= 4 * error + 0.05
        if found.method is Method.ALL_FUTURES and found.arrival_ticks is not None:
            first, last = found.arrival_ticks
            assert all(first <= ticks <= last for outcome, ticks in ends if outcome is Outcome.SUCCESS)
    assert open_cases > (2 if planner == "priority" else -1)


@pytest.fixture(scope="module")
def cases() -> list[calibration.Case]:
    """Answers at random moments, with what really came."""
    return list(calibration.cases(100, seed=3))


def test_what_is_stated_is_what_comes_of_it(cases: list[calibration.Case]) -> None:
    for case in cases:
        if case.stated in (0.0, 1.0):
            assert case.arrived == bool(case.stated), "what is stated without a doubt holds without exception"
    assert calibration.error(cases) < 0.03


def test_a_sample_never_states_all_or_none(cases: list[calibration.Case]) -> None:
    sampled = [case for case in cases if case.found.method is Method.SAMPLED]
    assert sampled
    for case in sampled:
        found = case.found
        assert 0.0 < case.stated < 1.0
        assert found.futures is not None
        assert (found.low, found.high) == wilson(round(found.arrives * found.futures), found.futures)
        assert found.low < found.high


def test_work_is_limited_and_the_same_moment_has_the_same_answer() -> None:
    draw = random.Random(9)
    for _ in range(20):
        timeline = Timeline(calibration.drawn_config(draw))
        found = confidence(timeline)
        limit = traits_of(timeline.config.planner).decisions_per_answer + 2 * timeline.config.max_ticks
        assert found.decisions <= limit
        assert confidence(timeline.copy()) == found


def test_seen_courtesy_of_the_coming_tick_is_no_chance() -> None:
    """The sensors see who gives way before the vehicle decides; only what comes after is drawn."""
    world = road("........", "........", "........", "..>A<...")
    for seed in range(20):
        state = run_on(world, courtesy=0.5, seed=seed)
        after = step(state)
        if after.state.world.outcome is Outcome.CRASH:
            assert of(state).crashes == 1.0


def test_a_way_shut_by_hazards_is_not_run_to_its_end() -> None:
    world = road("........", "########", "........", "...A....")
    for planner, decisions in (("priority", module.PROOF_AFTER), ("bfs", 0)):
        found = of(run_on(world, planner=planner, repetition=False))
        assert (found.shut_off, found.arrives, found.end_ticks) == (1.0, 0.0, None)
        assert found.decisions == decisions


def test_what_is_proved_hopeless_never_arrives() -> None:
    """Rows of movers with no gap are proved shut, whoever gives way; what is not proved is run."""
    draw, proved = random.Random(5), 0
    while proved < 12:
        config = calibration.drawn_config(draw).with_parts(planner="bfs")
        if config.rows > 8:
            continue
        timeline = Timeline(config)
        found = confidence(timeline)
        if found.shut_off == 1.0:
            proved += 1
            ends = ends_under_other_seeds(timeline.state, 3)
            assert all(outcome is not Outcome.SUCCESS for outcome, _ in ends)


def test_a_person_who_drives_is_told_how_it_goes_without_them() -> None:
    state = run_on(road("........", "........", "........", "...A...."))
    by_hand = of(state.with_ego(mode=Mode.MANUAL))
    assert by_hand.by_hand
    assert by_hand.arrival_ticks == of(state).arrival_ticks == (3, 3)
    waited = of(state.with_ego(mode=Mode.MANUAL, queue=(Move.STAY, Move.STAY)))
    assert waited.arrival_ticks == (5, 5), "moves that were asked for are made first"


def test_after_the_end_there_is_nothing_to_be_sure_of() -> None:
    timeline = Timeline(Config(vehicles=0, potholes=0))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    with pytest.raises(QuestionError) as caught:
        confidence(timeline)
    assert caught.value.code == "confidence_ended"


def test_how_clear_the_last_move_was() -> None:
    timeline = Timeline(Config(rows=8, vehicles=0, potholes=0, planner="bfs"))
    assert confidence(timeline).clarity is None
    timeline.advance()
    clarity = confidence(timeline).clarity
    assert clarity is not None
    costs = [option.cost for option in clarity.decision.options]
    assert (clarity.next_best, clarity.gap) == (clarity.decision.options[1].move, costs[1] - costs[0])


@pytest.mark.parametrize(
    ("hits", "tries", "low", "high"),
    [(0, 10, 0.0, 0.2775), (5, 10, 0.2366, 0.7634), (81, 263, 0.2553, 0.3662)],
)
def test_wilson_as_tabled(hits: int, tries: int, low: float, high: float) -> None:
    assert wilson(hits, tries) == pytest.approx((low, high), abs=5e-5)
