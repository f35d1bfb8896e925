"""Changes that are tried at once lead where the actions of a person lead, and nothing is left untried."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.config import Config
from sim.explain import why, why_not
from sim.explain.intervention import Intervention
from sim.explain.smallest_change import ChangeSearch
from sim.explain.tried_together import TogetherTried
from sim.explain.why_causes import by_salience
from sim.search.compiled_costs import forget_compiled_costs, load_compiled_costs
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.support.sentence_judge import changes_reaching

pytestmark = pytest.mark.xdist_group("compiled")

SEEDS = st.integers(0, 2**32 - 1)
PLANNERS = st.sampled_from(["astar", "dijkstra", "bfs"])


@pytest.fixture(autouse=True)
def _loaded() -> Iterator[None]:
    load_compiled_costs(compile_now=True)
    yield
    forget_compiled_costs()


def small_drive(seed: int, planner: str) -> Timeline:
    draw = random.Random(seed)
    config = Config(
        seed=seed,
        columns=draw.choice([3, 4]),
        rows=draw.choice([5, 6]),
        potholes=draw.choice([1, 2, 3]),
        vehicles=draw.choice([1, 2, 4]),
        pedestrians=draw.choice([0, 1]),
        barriers=draw.choice([0, 1]),
        preferences=draw.choice([(), ("cautious",)]),
        planner=planner,
    )
    timeline = Timeline(config)
    for _ in range(draw.randrange(1, 4)):
        timeline.advance()
    return timeline


@settings(max_examples=25)
@given(SEEDS, PLANNERS)
def test_a_change_leads_where_its_actions_lead(seed: int, planner: str) -> None:
    timeline = small_drive(seed, planner)
    state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
    if made is None:
        return
    rerun = Intervention(state, made)
    if rerun.quick is None:  # the last tick of an episode
        return
    search = ChangeSearch(rerun, Move.STAY, [*rerun.factors, *by_salience(rerun.percept, made)])
    together = TogetherTried(rerun, rerun.quick, search._edits)
    for size in (1, 2, 3):
        changes = list(combinations(range(len(search._edits)), size))
        some = random.Random(seed).sample(changes, min(12, len(changes)))
        found = together.made(some)
        assert any(found)
        for change, move in zip(some, found, strict=True):
            edits = tuple(search._edits[number] for number in change)
            assert move is None or move is search._done(edits), edits


def test_what_stands_for_good_refuses_a_wall_unless_it_is_taken_away() -> None:
    refused = 0
    for seed in range(12):
        timeline = Timeline(Config(seed=seed, columns=6, rows=12, potholes=15, planner="rules"))
        for _ in range(3):
            timeline.advance()
        state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
        if made is None or state.world.outcome is not Outcome.RUNNING:
            continue
        rerun = Intervention(state, made)
        search = ChangeSearch(rerun, Move.STAY, by_salience(rerun.percept, made))
        for edits in combinations(search._edits, 2):
            if search._is_refused(edits):
                assert search._done(edits) is None
                refused += 1
    assert refused


@settings(max_examples=10)
@given(SEEDS, PLANNERS)
def test_the_change_told_is_as_small_as_there_is(seed: int, planner: str) -> None:
    timeline = small_drive(seed, planner)
    state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
    if made is None or state.world.outcome is not Outcome.RUNNING:
        return
    foil = random.Random(seed).choice([move for move in Move if move is not made.move])
    if made.option(foil).cell is None:
        return
    told = [flip.change for flip in why_not(timeline, foil).counterfactuals if flip.move is foil]
    smallest = next(changes_reaching(state, foil, 2), None)
    if smallest is not None:
        assert len(told[0]) == len(smallest)
    elif told:
        assert len(told[0]) > 2


@pytest.mark.parametrize("planner", ["astar", "dijkstra", "bfs"])
@pytest.mark.parametrize("seed", range(6))
def test_on_a_default_road_everything_is_taken_away_by_itself(seed: int, planner: str) -> None:
    timeline = Timeline(Config(seed=seed, planner=planner))
    for _ in range(3 + seed):
        timeline.advance()
    found = why(timeline)
    assert not found.untried
    named = {cause.id for cause in (*found.causes, *found.also)}
    rerun = Intervention(found.moment, found.decision)
    forget_compiled_costs()  # tried again by searching, one by one
    again = Intervention(found.moment, found.decision)
    again.quick = None
    for name in by_salience(rerun.percept, found.decision):
        if again.decision_without([name]).move is not found.decision.move:
            assert name in named
