"""What a person may change of the run itself, also when it has ended; anything is done or refused."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import (
    Add,
    Drive,
    PlannerName,
    Remove,
    Reset,
    Scenario,
    SetCount,
    SetMode,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.events import EventType
from sim.generation import generate
from sim.session.edits import MAX_QUEUE, Change, apply
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Mode, Move, Outcome
from sim.world import Thing
from tests.support.edits import EMPTY, FULL, KINDS, refusal, sound, tried
from tests.support.roads import road, run_on

# Scenarios, reset, mode, drive


def test_a_scenario_is_a_fresh_road() -> None:
    state = SimState.start(Config(seed=6))
    for _ in range(5):
        state = step(state).state
    applied = apply(state, Scenario(road="city", potholes=10, traffic="none"))
    world = applied.state.world
    there = {kind: count for kind, count in world.counts().items() if count}
    assert there == {Kind.POTHOLE: 10, Kind.BARRIER: 3, Kind.PEDESTRIAN: 4}
    assert (world.tick, world.episode, world.episode_start, world.outcome) == (5, 2, 5, Outcome.RUNNING)
    assert world.av == world.road.start
    assert [event.type for event in applied.events] == [EventType.EPISODE_STARTED]
    assert applied.state.metrics == state.metrics
    told = {change.path: (change.before, change.after) for change in applied.changes}
    assert told["config.road"] == (None, "city")
    assert told["config.traffic"] == (None, "none")
    assert told["config.potholes"] == (None, 10)
    assert told["potholes"] == (state.world.count(Kind.POTHOLE), 10)
    assert told["episode"] == (1, 2)


@pytest.mark.parametrize("planner", ["dwa", "rl", "cooperative"])
def test_planners_of_later_versions_are_refused(planner: PlannerName) -> None:
    error = refusal(EMPTY, Scenario(planner=planner))
    assert (error.category, error.field) == ("not-available", "planner")
    assert error.facts["problem"].facts == {"value": planner}


def test_a_new_thing_is_not_placed_by_an_id() -> None:
    error = refusal(FULL, Add(kind="pothole", count=1, where=Where(id="vehicle-1")))
    assert (error.category, error.field) == ("bad-place", "where")


def test_more_autonomous_vehicles_are_refused() -> None:
    assert refusal(EMPTY, Scenario(avs=1)).category == "not-available"
    assert apply(EMPTY, Scenario(avs=0)).state.world.count(Kind.AV) == 1


def test_reset_goes_back_to_the_start_of_the_episode_with_time_going_on() -> None:
    state = SimState.start(Config(seed=6))
    start = state.world
    for _ in range(7):
        state = step(state).state
    state = apply(state, Add(kind="barrier", count=3)).state
    applied = apply(state, Reset())
    world = applied.state.world
    assert (world.tick, world.episode, world.episode_tick) == (7, 1, 0)
    assert (world.right, world.left, world.fixed, world.av) == (
        start.right,
        start.left,
        start.fixed,
        start.av,
    )
    assert [event.type for event in applied.events] == [EventType.EPISODE_STARTED]
    assert applied.state.config == state.config
    assert applied.state.metrics.steps == 7


def test_mode_and_moves() -> None:
    manual = apply(EMPTY, SetMode(mode=Mode.MANUAL))
    assert manual.state.mode is Mode.MANUAL
    assert manual.changes == (Change("mode", Mode.AUTO, Mode.MANUAL),)
    assert step(manual.state).state.world.av == EMPTY.world.av, "without a move it waits"
    driven = apply(manual.state, Drive(move=Move.LEFT))
    assert driven.changes == (Change("queue", (), (Move.LEFT,)),)
    driven = apply(driven.state, Drive(move=Move.FORWARD))
    state = step(driven.state).state
    assert state.world.road.cell(state.world.av) == (2, 4)
    state = step(state).state
    assert state.world.road.cell(state.world.av) == (2, 3)
    assert state.queue == ()
    waiting = apply(state, Drive(move=Move.LEFT)).state
    assert apply(waiting, SetMode(mode=Mode.AUTO)).state.queue == (), "who takes over finds no old orders"


def test_a_move_of_a_person_is_taken_once_and_then_the_planner_goes_on() -> None:
    state = apply(EMPTY, Drive(move=Move.STAY)).state
    tick = step(state)
    assert tick.decision is not None
    assert (tick.decision.planner, tick.decision.move) == ("manual", Move.STAY)
    tick = step(tick.state)
    assert tick.decision is not None
    assert (tick.decision.planner, tick.decision.move) == ("priority", Move.FORWARD)


def test_a_move_into_a_hazard_is_held_back_and_the_log_says_why() -> None:
    state = run_on(road("...", ".o.", ".A.", "..."))
    tick = step(apply(state, Drive(move=Move.FORWARD)).state)
    assert tick.decision is not None
    assert tick.decision.held_back
    assert (tick.decision.asked, tick.decision.move) == (Move.FORWARD, Move.STAY)
    (event,) = tick.events
    assert (event.type, event.ids, event.cell, event.move) == (
        EventType.HELD_BACK,
        ("pothole-1",),
        (1, 1),
        Move.FORWARD,
    )


def test_so_many_moves_may_wait_and_no_more() -> None:
    state = EMPTY.with_ego(queue=(Move.STAY,) * MAX_QUEUE)
    error = refusal(state, Drive(move=Move.LEFT))
    assert (error.category, error.field) == ("too-many", "move")


# While a result stands


@pytest.fixture
def ended() -> SimState:
    state = SimState.start(Config(seed=6))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return step(state).state


@pytest.mark.parametrize(
    "action",
    [
        Add(kind="pothole", count=2),
        SetCount(kind="vehicle", count=3),
        Remove(kind="vehicle", count="all"),
        Remove(kind="vehicle", count=1),
        Drive(move=Move.LEFT),
    ],
)
def test_a_change_while_a_result_stands_is_made_to_the_next_road(
    ended: SimState, action: WorldAction
) -> None:
    applied = apply(ended, action)
    world = applied.state.world
    assert (world.episode, world.outcome, world.tick) == (2, Outcome.RUNNING, ended.world.tick)
    assert [event.type for event in applied.events] == [EventType.EPISODE_STARTED]
    assert Change("episode", 1, 2) in applied.changes
    fresh = generate(ended.config, 2, tick=ended.world.tick, numbered=ended.world.numbered)
    assert {thing.id for thing in applied.added}.isdisjoint(thing.id for thing in fresh.things())
    assert all(fresh.find(thing.id) == thing for thing in applied.removed)


def test_what_points_at_the_old_road_is_refused(ended: SimState) -> None:
    thing = next(ended.world.things())
    for where in (Where(nearest=True), Where(id=thing.id)):
        error = refusal(ended, Remove(kind="everything", count=1, where=where))
        assert (error.category, error.field) == ("none-there", "where")


def test_mode_may_change_while_the_result_stands(ended: SimState) -> None:
    applied = apply(ended, SetMode(mode=Mode.MANUAL))
    assert applied.state.world == ended.world


def test_a_refused_change_while_a_result_stands_begins_nothing(ended: SimState) -> None:
    refusal(ended, Add(kind="pothole", count=500))
    assert ended.world.episode == 1


# Anything at all

WHERES = st.builds(
    Where,
    lane=st.one_of(st.none(), st.sampled_from(["left", "middle", "right"]), st.integers(1, 9)),
    row=st.one_of(st.none(), st.integers(0, 12)),
    cell=st.one_of(st.none(), st.tuples(st.integers(0, 8), st.integers(0, 12))),
    side=st.sampled_from([None, None, "ahead", "behind", "left", "right"]),
    distance_m=st.one_of(st.none(), st.floats(0.1, 60)),
    cells=st.one_of(st.none(), st.integers(1, 12)),
    nearest=st.sampled_from([None, None, True]),
    id=st.sampled_from([None, None, None, "vehicle-1", "pothole-2", "av-1", "nobody"]),
)
ACTIONS = st.one_of(
    st.builds(Add, kind=st.sampled_from([*KINDS, "av"]), count=st.integers(1, 40), where=st.none() | WHERES),
    st.builds(
        Remove,
        kind=st.sampled_from([*KINDS, "av", "everything"]),
        count=st.integers(1, 9) | st.just("all"),
        where=st.none() | WHERES,
    ),
    st.builds(SetCount, kind=st.sampled_from(KINDS), count=st.integers(0, 60)),
    st.builds(
        Scenario,
        road=st.sampled_from([None, "highway", "city", "rural"]),
        traffic=st.sampled_from([None, "none", "heavy"]),
        potholes=st.none() | st.integers(0, 80),
    ),
    st.just(Reset()),
    st.builds(SetMode, mode=st.sampled_from(list(Mode))),
    st.builds(Drive, move=st.sampled_from(list(Move))),
)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 99), st.lists(st.tuples(st.integers(0, 6), ACTIONS), max_size=8))
def test_any_action_is_done_wholly_or_refused_in_a_sentence(
    seed: int, script: list[tuple[int, WorldAction]]
) -> None:
    state = SimState.start(Config(columns=7, rows=10, seed=seed, pedestrians=2, barriers=2))
    for ticks, action in script:
        for _ in range(ticks):
            state = step(state).state
        before: SimState = state
        things = {thing.id: thing for thing in before.world.things()}
        applied = tried(state, action)
        if applied is None:
            continue
        state = applied.state
        sound(state.world)
        after = {thing.id: thing for thing in state.world.things()}
        assert state.world.tick == before.world.tick
        assert all(after[thing.id] == thing for thing in applied.added)
        assert not any(thing.id in after for thing in applied.removed)
        if not any(event.type is EventType.EPISODE_STARTED for event in applied.events):
            check_edit(things, after, applied.added, applied.removed)


def check_edit(
    before: dict[str, Thing], after: dict[str, Thing], added: tuple[Thing, ...], removed: tuple[Thing, ...]
) -> None:
    """Within an episode, what was not added or removed is where it was."""
    assert set(after) == (set(before) | {thing.id for thing in added}) - {thing.id for thing in removed}
    for name in set(before) & set(after):
        assert (before[name].cell, before[name].heading) == (after[name].cell, after[name].heading)
