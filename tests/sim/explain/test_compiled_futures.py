"""What is found by kernels that work by rows is what is found without them, to the last bit."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import combinations

import pytest

from sim.config import Config
from sim.explain.compiled_futures import drive_is_compiled_for, futures_are_compiled_for
from sim.explain.episode_rollout import decided, drive, driven_in_words, rollout, summarize
from sim.explain.futures import Futures, find_ends
from sim.explain.intervention import Intervention
from sim.explain.smallest_change import ChangeSearch
from sim.explain.tried_together import TogetherTried
from sim.explain.why_causes import by_salience
from sim.forecast import Forecast
from sim.search.compiled_costs import forget_compiled_costs, load_compiled_costs
from sim.search.compiled_rows import BY_COST, BY_RANK, compiled_least_ticks, rows_are_compiled_for
from sim.search.reachability import steps_left
from sim.search.reactive import ImpatientError, ReactiveSearch
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome
from tests.support.reacting_roads import reacting_runs

pytestmark = pytest.mark.xdist_group("compiled")

SEEDS = range(4)
ALL = (*BY_RANK, *BY_COST)


@pytest.fixture(autouse=True)
def _loaded() -> Iterator[None]:
    load_compiled_costs(compile_now=True)
    yield
    forget_compiled_costs()


@pytest.mark.parametrize("seed", SEEDS)
def test_the_ends_of_all_futures_are_the_same(seed: int) -> None:
    draw, compared = random.Random(seed), 0
    for timeline in reacting_runs(40, seed, ALL):
        state = timeline.state
        if not futures_are_compiled_for(state):
            continue
        compared += 1
        most, seen = draw.choice([None, 40, 150]), draw.random() < 0.5
        found = find_ends(state, most=most, seen=seen)
        futures = Futures(state, most=most, seen=seen)
        ends, drawn = futures.walked(), None
        if ends is None:
            ends = futures.drawn()
            drawn = round(sum(ends.values()))
        assert list(found.ends.items()) == list(ends.items())
        assert (found.drawn, found.work, found.branched) == (drawn, futures.work, futures.branched > 0)
    assert compared > 20


@pytest.mark.parametrize("seed", SEEDS)
def test_a_run_is_the_same_tick_by_tick(seed: int) -> None:
    draw, compared = random.Random(seed), 0
    for timeline in reacting_runs(30, seed, ALL):
        state = timeline.state
        if not drive_is_compiled_for(state):
            continue
        compared += 1
        found, ticks = drive(state), list(rollout(state))
        assert found.story == summarize(state, ticks)
        made = [decided(tick, None) for _, tick in ticks]
        assert found.moves() == [(each.tick, each.move) for each in made if each is not None]
        before = draw.choice(ticks)[0].world
        there = found.at(before.tick).world
        assert there == before
        assert list(there.movers.items()) == list(before.movers.items())
    assert compared > 15


@pytest.mark.parametrize("planner", BY_RANK)
def test_a_run_that_may_repeat_itself_ends_in_words_as_it_does(planner: str) -> None:
    ends = set()
    for seed in range(30):
        config = Config(seed=seed, columns=8, rows=15, vehicles=14, potholes=8, barriers=4, planner=planner)
        state = Timeline(config).state
        *_, (_, last) = rollout(state)
        found = driven_in_words(state)
        assert found is None or found == last.state.world
        assert (found is None) is (last.state.world.outcome is Outcome.STUCK)
        ends.add(last.state.world.outcome)
    assert len(ends) > 1


@pytest.mark.parametrize("seed", SEEDS)
def test_the_least_ticks_are_the_same_with_as_many_states_looked_at(seed: int) -> None:
    draw, given_up = random.Random(seed), 0
    for timeline in reacting_runs(40, seed, BY_RANK):
        state, patience = timeline.state, draw.choice([20, 200, 1000])
        assert rows_are_compiled_for(state.world, state.config)
        limit = steps_left(state.config, state.world.episode_tick)
        search = ReactiveSearch(
            state.world, state.config, Forecast.of_truth(state.world, state.config, limit), patience
        )
        try:
            least = search.least_ticks(limit)
        except ImpatientError:
            given_up += 1
            with pytest.raises(ImpatientError):
                compiled_least_ticks(state.world, state.config, limit, patience)
        else:
            assert compiled_least_ticks(state.world, state.config, limit, patience) == least
    assert given_up


@pytest.mark.parametrize("seed", SEEDS)
def test_the_moves_after_changes_are_those_of_the_planner(seed: int) -> None:
    draw = random.Random(seed)
    for timeline in reacting_runs(15, seed, BY_RANK):
        state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
        assert made is not None
        rerun = Intervention(state, made)
        assert rerun.quick is not None
        names = by_salience(rerun.percept, made)
        search = ChangeSearch(rerun, Move.STAY, names)
        together, numbers = TogetherTried(rerun, rerun.quick, search._edits), range(len(search._edits))
        pairs = list(combinations(numbers, 2))
        for some in (list(combinations(numbers, 1)), draw.sample(pairs, min(10, len(pairs)))):
            for change, move in zip(some, together.made(some), strict=True):
                edits = tuple(search._edits[number] for number in change)
                assert move is None or search._done(edits) is move, edits
        gone = draw.sample(names, len(names) // 2)
        assert rerun.without(gone) is rerun.decision_without(gone).move


def test_what_they_are_not_made_for_goes_the_slow_way() -> None:
    (timeline,) = reacting_runs(1, 1, ["rules"])
    state = timeline.state
    assert drive_is_compiled_for(state)
    assert not drive_is_compiled_for(state.with_ego(mode=Mode.MANUAL))
    assert not futures_are_compiled_for(state.with_ego(queue=(Move.LEFT,)))
    forget_compiled_costs()
    assert not rows_are_compiled_for(state.world, state.config)
