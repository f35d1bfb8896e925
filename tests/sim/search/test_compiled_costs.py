"""The compiled costs are those that the searches find, and answer for nothing that they are not made for."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from typing import get_args

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sim.actions import Preference
from sim.batch.move_kernel import WORTH_A_BASE
from sim.batch.percept_words import is_compiled_for
from sim.config import Collision, Config
from sim.decide import decide, decide_on, sense
from sim.forecast import Forecast
from sim.perceive import OtherEgo
from sim.plan.astar import searched
from sim.search import compiled_costs as compiled
from sim.search.backward_dp import totals_by_move
from sim.search.continued import forget
from sim.search.costs import weights
from sim.search.reachability import longest_lasting, steps_left
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import MOVES, Kind, Move, Outcome
from sim.world import World
from sim.world.grid import board_of, union
from tests.support.roads import road, run_on, worlds
from tests.support.slow_search import totals
from tests.support.twin import position

pytestmark = pytest.mark.xdist_group("compiled")

PREFERENCES = st.lists(st.sampled_from(get_args(Preference)), unique=True, max_size=3)
REACTIONS = st.fixed_dictionaries(
    {
        "courtesy": st.sampled_from([0.0, 0.7]),
        "attentive": st.sampled_from([0.0, 0.5, 1.0]),
        "collision": st.sampled_from(get_args(Collision)),
    }
)
SHUT_IN = road(".....", "#####", ".....", ".>A..")
"""A road without a way to the goal, and with a mover."""


@pytest.fixture(autouse=True)
def _loaded() -> Iterator[None]:
    compiled.load_compiled_costs(compile_now=True)
    yield
    compiled.forget_compiled_costs()


def foreseen(state: SimState) -> tuple[Forecast, int]:
    limit = steps_left(state.config, state.world.episode_tick)
    return Forecast.of_truth(state.world, state.config, max(1, limit)), limit


@settings(max_examples=120)
@given(worlds(max_columns=9, max_rows=9), PREFERENCES, st.integers(0, 3), REACTIONS)
@example(SHUT_IN, [], 1, {"attentive": 1.0})
@example(road(".....", ".....", ".....", ">A..."), [], 1, {"attentive": 1.0})
def test_the_totals_are_those_of_every_search(
    world: World, wishes: list[Preference], buffer: int, reactions: dict[str, object]
) -> None:
    state = run_on(world, preferences=tuple(wishes), safety_buffer=buffer, **reactions)
    forecast, limit = foreseen(state)
    charges = weights(state.config)
    found = compiled.compiled_costs(forecast.percept, charges, limit)
    if limit < 2:
        assert found is None
        return
    assert found is not None
    forget()
    swept = totals_by_move(forecast, charges, limit)
    assert found.totals == swept == tuple(searched(forecast, charges, limit))
    if any(total is not None for total in swept):
        assert found.lasting is None
    else:
        assert found.lasting is longest_lasting(forecast, limit)


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["astar", "dijkstra", "bfs"]), st.sampled_from([0.0, 0.5]))
def test_a_drive_is_the_same_with_them_and_without(seed: int, planner: str, courtesy: float) -> None:
    config = Config(
        seed=seed,
        columns=6,
        rows=9,
        potholes=6,
        vehicles=9,
        pedestrians=2,
        courtesy=courtesy,
        planner=planner,
    )
    timeline = Timeline(config)
    for _ in range(12):
        state = timeline.state
        with_them = decide(state)
        compiled.forget_compiled_costs()
        forget()
        assert decide(state) == with_them
        compiled.load_compiled_costs()
        timeline.advance()


@settings(max_examples=60)
@given(worlds(max_columns=8, max_rows=8), PREFERENCES, REACTIONS, st.randoms(use_true_random=False))
def test_moves_after_changes_are_those_of_the_planner(
    world: World, wishes: list[Preference], reactions: dict[str, object], draw: random.Random
) -> None:
    state = run_on(world, planner="dijkstra", preferences=tuple(wishes), **reactions)
    percept, charges = sense(state)[0], weights(state.config)
    limit = steps_left(state.config, percept.episode_tick)
    names = [*percept.movers.values(), *percept.hazards.values()]
    if state.world.outcome is not Outcome.RUNNING or limit < 2 or not names:
        return
    gone = [draw.sample(names, draw.randint(0, len(names))) for _ in range(5)]
    unlike = [
        compiled.Unlike(
            board_of([cell for cell, name in percept.movers.items() if name in some]),
            board_of([cell for cell, name in percept.hazards.items() if name in some]),
        )
        for some in gone
    ]
    found = compiled.move_kernel(percept, limit).moves(unlike, charges)
    compiled.forget_compiled_costs()
    assert found == [decide_on(state, percept.without(some)).move for some in gone]
    compiled.load_compiled_costs()


def test_barriers_and_potholes_may_be_added() -> None:
    state = run_on(road(".....", ".....", ".....", "..A..", "....."), planner="dijkstra")
    percept, charges = sense(state)[0], weights(state.config)
    limit = steps_left(state.config, percept.episode_tick)
    ahead = board_of([11, 12, 13])
    added = (compiled.Unlike(barriers=ahead), Kind.BARRIER), (compiled.Unlike(potholes=ahead), Kind.POTHOLE)
    for unlike, kind in added:
        found = compiled.move_kernel(percept, limit).moves([compiled.Unlike(), unlike], charges)
        boards = percept.boards.with_kind(kind, ahead)
        seen = replace(percept, boards=boards, hazards={11: "a", 12: "b", 13: "c"})
        assert found == [Move.FORWARD, decide_on(state, seen).move]


@settings(max_examples=60)
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([0, 12, 30]),
    st.sampled_from([0, 10, 40]),
    st.sampled_from([3, 8, 11]),
    PREFERENCES,
    REACTIONS,
)
def test_what_is_kept_of_a_road_answers_as_a_decision_of_its_own(
    seed: int,
    vehicles: int,
    hazards: int,
    columns: int,
    wishes: list[Preference],
    reactions: dict[str, object],
) -> None:
    config = Config(
        seed=seed,
        columns=columns,
        rows=20,
        potholes=hazards * columns // 8,
        barriers=hazards * columns // 16,
        vehicles=vehicles * columns // 8,
        pedestrians=vehicles // 6,
        preferences=tuple(wishes),
        planner="astar",
    ).with_parts(**reactions)
    draw, timeline = random.Random(seed), Timeline(config)
    for _ in range(draw.randrange(12)):
        timeline.advance()
    state = timeline.state
    percept, charges = sense(state)[0], weights(config)
    limit = steps_left(config, percept.episode_tick)
    if state.world.outcome is not Outcome.RUNNING or limit < 2:
        return
    taken = {percept.ego, *percept.movers, *percept.hazards}
    free = [cell for cell in range(percept.ego + columns) if cell not in taken]
    things = [compiled.Unlike(movers=1 << cell) for cell in percept.movers]
    things += [compiled.Unlike(fixed=1 << cell) for cell in percept.hazards]
    added = [compiled.Unlike(barriers=1 << cell) for cell in draw.sample(free, min(15, len(free)))]
    added += [compiled.Unlike(potholes=1 << cell) for cell in percept.movers]
    parts = [*things, *added]
    if len(parts) < WORTH_A_BASE:
        return
    numbers = range(len(parts))
    several = [tuple(draw.sample(numbers, 3)) for _ in range(30)]
    kept, anew = compiled.move_kernel(percept, limit), compiled.move_kernel(percept, limit)
    for chosen in ([(number,) for number in numbers], several):
        found = kept.moves_of(kept.parts(parts), {charges: chosen})[charges]
        for numbers_of, move in zip(chosen, found, strict=True):
            alone = anew.moves_of(anew.parts(parts), {charges: [numbers_of]})
            assert [move] == alone[charges], numbers_of
    left = [draw.sample(things, min(4, len(things))) for _ in range(10)]
    rest = [
        compiled.Unlike(
            board_of(percept.movers) & ~union(each.movers for each in some),
            board_of(percept.hazards) & ~union(each.fixed for each in some),
        )
        for some in left
    ]
    assert kept.moves(rest, charges) == [anew.moves([each], charges)[0] for each in rest]


@settings(max_examples=25)
@given(worlds(max_columns=5, max_rows=6), PREFERENCES, st.integers(0, 2))
def test_the_slow_search_over_the_twin_agrees(world: World, wishes: list[Preference], buffer: int) -> None:
    state = run_on(world, preferences=tuple(wishes), safety_buffer=buffer)
    forecast, limit = foreseen(state)
    charges = weights(state.config)
    found = compiled.compiled_costs(forecast.percept, charges, limit)
    if found is None:
        return
    bound = max((total for total in found.totals if total is not None), default=0)
    horizon = max(world.road.rows + 6, bound // charges.tick)
    assert dict(zip(MOVES, found.totals, strict=True)) == totals(position(world), charges, horizon)


def test_what_they_are_not_made_for_is_searched() -> None:
    state = run_on(road(".....", ".....", ".....", "..A.."))
    percept, charges = sense(state)[0], weights(state.config)
    doubted = replace(percept, doubtful=(board_of([11]),))
    accompanied = replace(percept, egos=(OtherEgo("av-2", 4, Move.STAY, parked=True),))
    assert compiled.compiled_costs(percept, charges, 20) is not None
    for seen in (doubted, accompanied, replace(percept, behaviour="another"), replace(percept, dynamics="x")):
        assert not is_compiled_for(seen, charges, 20)


def test_nothing_is_compiled_unless_it_is_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled.forget_compiled_costs()
    monkeypatch.setattr(compiled, "ready_mark", lambda _: None)
    assert not compiled.are_compiled()
    assert not compiled.wait_to_be_compiled()
    assert not compiled.load_compiled_costs()
    assert not compiled.are_loaded()
