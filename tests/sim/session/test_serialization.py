"""A state that was written as JSON and read again is the very same, and goes on the same."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Add, Drive, Prefer, Remove, Reset, Scenario, Set, SetMode, Where
from sim.config import Config
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.serialization import Packer, Unpacker
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Mode, Move, Outcome
from tests.support.roads import run_on, worlds

ACTIONS = st.sampled_from(
    [
        Add(kind="pothole", count=3),
        Add(kind="vehicle", count=2, where=Where(side="ahead")),
        Add(kind="pedestrian", count=2),
        Add(kind="barrier", count=4),
        Remove(kind="everything", count="all", where=Where(lane="left")),
        Scenario(road="city", weather="rain"),
        Scenario(weather="fog"),
        Reset(),
        SetMode(mode=Mode.MANUAL),
        SetMode(mode=Mode.AUTO),
        Drive(move=Move.FORWARD_LEFT),
        Drive(move=Move.STAY),
        Prefer(preference="cautious"),
        Set(parameter="planner", value="astar"),
        Set(parameter="courtesy", value=0.3),
        Set(parameter="rows", value=9),
        Set(parameter="step_seconds", value=1),
    ]
)
CONFIGS = st.builds(
    Config,
    columns=st.integers(4, 9),
    rows=st.integers(6, 12),
    potholes=st.none() | st.integers(0, 3),
    pedestrians=st.integers(0, 2),
    cell_m=st.sampled_from([5, 5.0, 0.7, 4 / 3]),
    seed=st.integers(0, 2**53 - 1),
    preferences=st.sampled_from([(), ("cautious",), ("fastest", "smooth_ride")]),
)


def there_and_back(*runs: SimState) -> list[SimState]:
    packer = Packer()
    numbers = [packer.run(state) for state in runs]
    unpacked = Unpacker(json.loads(json.dumps(packer.packed())))
    return [unpacked.runs[number] for number in numbers]


def same(one: SimState, other: SimState) -> None:
    assert one == other
    assert repr(one) == repr(other), "types too: 1 is not 1.0, and tables have an order"
    assert one.world.digest() == other.world.digest()


@settings(max_examples=80, deadline=None)
@given(config=CONFIGS, script=st.lists(st.tuples(st.integers(0, 30), ACTIONS), max_size=8))
def test_every_state_of_a_session(config: Config, script: list[tuple[int, Any]]) -> None:
    state, seen = SimState.start(config), []
    for ticks, action in script:
        for _ in range(ticks):
            state = step(state).state
            seen.append(state)
        try:
            state = apply(state, action).state
        except EditError:
            continue
        seen.append(state)
    seen.append(state)
    for one, other in zip(seen, there_and_back(*seen), strict=True):
        same(one, other)
    (again,) = there_and_back(state)
    for _ in range(5):
        state, again = step(state).state, step(again).state
        assert again == state


@given(world=worlds())
def test_every_world(world: Any) -> None:
    state = run_on(world)
    same(state, *there_and_back(state))


def test_ends_and_what_stood_before_them() -> None:
    seen, outcomes = [], set()
    state = SimState.start(
        Config(seed=3, rows=8, columns=4, potholes=4, vehicles=6, planner="priority", attentive=0.0)
    )
    for number in range(400):
        if number % 7 == 3:
            state = apply(state, Drive(move=tuple(Move)[number % 6])).state
        state = step(state).state
        seen.append(state)
        outcomes.add(state.world.outcome)
    assert {Outcome.SUCCESS, Outcome.CRASH} <= outcomes
    assert any(each.record.last is not None for each in seen)
    assert any(each.world.cause is not None for each in seen)
    assert any(each.queue for each in [apply(state, Drive(move=Move.LEFT)).state, state])
    for one, other in zip(seen, there_and_back(*seen), strict=True):
        same(one, other)


def test_a_planner_of_another_package_and_what_it_did_instead() -> None:
    state = SimState.start(Config(planner="priority")).with_ego(fault="did not answer within 1 s")
    same(state, *there_and_back(state))


def test_what_is_shared_is_written_once_and_shared_again() -> None:
    state = SimState.start(Config(seed=5, potholes=3))
    seen = [state]
    for _ in range(8):
        seen.append(step(seen[-1]).state)
    packer = Packer()
    numbers = [packer.run(each) for each in (*seen, *seen)]
    packed = packer.packed()
    assert numbers[:9] == numbers[9:]
    assert [len(packed[name]) for name in ("configs", "runs", "worlds", "numbered")] == [1, 9, 9, 1]
    again = Unpacker(packed).runs
    assert len({id(each.config) for each in again}) == 1
    assert len({id(each.world.hazards) for each in again}) == 1
    assert again[3].record.start is again[0].world
    assert packer.planners() == {"rules"}


@pytest.mark.parametrize(
    "path",
    [
        ("digest",),
        ("worlds", 0, 2),
        ("worlds", 0, 9),
        ("worlds", 0, 8, 0),
        ("configs", 0),
        ("runs", 0, 0),
        ("tables", 0, 0),
        ("numbered", 0),
    ],
)
def test_what_cannot_be_read_is_told(path: tuple[Any, ...]) -> None:
    packer = Packer()
    packer.run(SimState.start(Config(seed=5)))
    packed = json.loads(json.dumps(packer.packed()))
    place = packed
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = 77
    with pytest.raises((ValueError, TypeError, LookupError)):
        Unpacker(packed)


def test_kinds_of_numbers_given_are_kinds_again() -> None:
    state = SimState.start(Config(seed=5, pedestrians=2))
    (again,) = there_and_back(state)
    assert {type(kind) for kind in again.world.numbered} == {Kind}
