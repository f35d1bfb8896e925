"""Moving, swapping, replacing and copying things that are on the road; a road that grows and shrinks."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import (
    Add,
    Adjust,
    Copy,
    Landmark,
    MoveThings,
    OneThing,
    Remove,
    Replace,
    Shift,
    Swap,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.events import EventType
from sim.session.edits import Change, apply
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Cell, Kind, Outcome
from sim.validation import validate_world
from sim.world import World
from tests.support.edits import EMPTY, FULL, KINDS, refusal, sound, tried
from tests.support.roads import grid, road, run_on

NEAREST = Where(nearest=True)


def cells_of(world: World, kind: Kind) -> set[Cell]:
    return {thing.cell for thing in world.things() if thing.kind is kind}


# Moving


def test_a_thing_is_moved_and_stays_itself() -> None:
    applied = apply(FULL, MoveThings(kind="vehicle", count=1, where=NEAREST, by=Shift(side="left", cells=2)))
    (moved,) = applied.moved
    before = FULL.world.find(moved.thing.id)
    assert before is not None
    assert (before.cell, moved.before, moved.thing.cell) == ((2, 5), (2, 5), (0, 5))
    assert moved.thing.heading == before.heading
    assert applied.changes == (Change(f"{before.id}.cell", (2, 5), (0, 5)),)
    assert applied.state.world.av == FULL.world.av
    sound(applied.state.world)


def test_a_lane_is_reached_in_the_row_a_thing_is_in() -> None:
    applied = apply(FULL, MoveThings(kind="barrier", count=1, where=NEAREST, to=Where(lane=2)))
    assert applied.moved[0].thing.cell == (1, 1)


def test_several_things_move_together_though_one_takes_the_cell_of_another() -> None:
    state = run_on(road("....", ".oo.", "..A.", "...."))
    applied = apply(state, MoveThings(kind="pothole", count="all", by=Shift(side="right", cells=1)))
    assert grid(applied.state.world)[1] == "..oo"
    assert {each.thing.id for each in applied.moved} == {"pothole-1", "pothole-2"}


def test_a_held_car_that_is_moved_is_free_and_one_that_is_given_a_pothole_is_held() -> None:
    state = run_on(road("....", ".}..", "..A.", "...."))
    freed = apply(state, MoveThings(kind="vehicle", count=1, where=NEAREST, by=Shift(side="right")))
    assert not freed.state.world.disabled
    back = apply(freed.state, MoveThings(kind="pothole", count=1, where=NEAREST, to=Where(cell=(2, 1))))
    assert back.state.world.disabled
    assert [event.type for event in back.events] == [EventType.DISABLED]


@pytest.mark.parametrize(
    ("action", "code"),
    [
        (MoveThings(kind="barrier", count=1, where=NEAREST, by=Shift(side="right", cells=2)), "too_far"),
        (MoveThings(kind="vehicle", count=1, where=NEAREST, to=Where(cell=(3, 4))), "occupied"),
        (MoveThings(kind="vehicle", count=1, where=NEAREST, to=Where(cell=(5, 1))), "occupied"),
        (MoveThings(kind="vehicle", count=9, to=Where(lane=1)), "too_few"),
        (MoveThings(kind="vehicle", count=1, to=Where(id="pothole-1")), "id_is_no_place"),
        (MoveThings(kind="vehicle", count=1, to=Where(each="lane")), "each_is_for_new_things"),
        (MoveThings(kind="av", count=1, to=Where(lane=1)), "other_vehicles_not_available"),
        (MoveThings(kind="vehicle", count=1, where=Where(row=0), to=Where(lane=1)), "none_there"),
        (MoveThings(kind="barrier", count=1, to=Where(of=Landmark(id="pothole-9"))), "no_such_thing"),
        (Swap(first=OneThing(kind="barrier"), second=OneThing(kind="barrier")), "same_thing"),
        (Replace(kind="barrier", count="all", by="barrier"), "same_kind"),
        (Copy(kind="barrier", count=1, to=Where(cell=(3, 4))), "occupied"),
        (Adjust(parameter="columns", by=-2), "would_fall_off"),
        (Adjust(parameter="rows", by=-2), "would_fall_off"),
    ],
)
def test_what_cannot_be_done_changes_nothing(action: WorldAction, code: str) -> None:
    assert refusal(FULL, action).code == code


# Swapping, replacing, copying


def test_two_things_change_places() -> None:
    applied = apply(
        FULL, Swap(first=OneThing(kind="vehicle", where=NEAREST), second=OneThing(kind="barrier"))
    )
    one, other = applied.moved
    assert (one.thing.cell, other.thing.cell) == (other.before, one.before)
    assert grid(applied.state.world)[1] == "..>..<."
    sound(applied.state.world)


def test_things_become_things_of_another_kind_in_their_places() -> None:
    applied = apply(FULL, Replace(kind="pothole", count="all", by="vehicle"))
    world = applied.state.world
    assert cells_of(world, Kind.POTHOLE) == set()
    assert cells_of(world, Kind.VEHICLE) == cells_of(FULL.world, Kind.POTHOLE) | cells_of(
        FULL.world, Kind.VEHICLE
    )
    assert len(applied.added) == len(applied.removed) == 4
    assert {change.path for change in applied.changes} == {"potholes", "vehicles"}
    sound(world)


def test_a_mover_keeps_its_heading_as_another_mover() -> None:
    applied = apply(FULL, Replace(kind="vehicle", count="all", by="pedestrian"))
    assert [thing.heading for thing in applied.added] == [thing.heading for thing in applied.removed]


def test_a_copy_stands_beside_what_it_is_a_copy_of() -> None:
    applied = apply(FULL, Copy(kind="barrier", count=1, where=NEAREST))
    (new,) = applied.added
    assert new.cell in ((4, 1), (6, 1))
    assert applied.removed == ()
    told = apply(FULL, Copy(kind="vehicle", count=1, where=NEAREST, to=Where(lane=1, row=3)))
    assert (told.added[0].cell, told.state.world.count(Kind.VEHICLE)) == ((0, 3), 3)


# Places


@pytest.mark.parametrize(
    ("where", "expected"),
    [
        (Where(lanes=(2, 3)), {(column, row) for column in (1, 2) for row in range(1, 5)}),
        (Where(rows=(3, 1)), {(column, row) for column in range(7) for row in (1, 2, 3)}),
        (Where(side="beside"), {(2, 4), (4, 4)}),
        (Where(side="beside", cells=2), {(1, 4), (5, 4)}),
    ],
)
def test_wider_places(where: Where, expected: set[Cell]) -> None:
    applied = apply(EMPTY, Add(kind="barrier", count=2, where=where))
    assert {thing.cell for thing in applied.added} <= expected


def test_a_number_holds_for_each_lane() -> None:
    applied = apply(EMPTY, Add(kind="pothole", count=2, where=Where(each="lane", lanes=(2, 4))))
    assert sorted(thing.cell[0] for thing in applied.added) == [1, 1, 2, 2, 3, 3]
    full = apply(EMPTY, Add(kind="pothole", count=1, where=Where(each="lane")))
    less = apply(full.state, Remove(kind="pothole", count=1, where=Where(each="lane", lanes=(1, 2))))
    assert {thing.cell[0] for thing in less.removed} == {0, 1}


@pytest.mark.parametrize(("row", "free_row"), [(3, 1), (1, None)])
def test_a_taken_lane_is_told_with_the_nearest_free_row(row: int, free_row: int | None) -> None:
    traffic = run_on(road(".......", ".......", "..>....", ".<.....", "...A...", "......."))
    if free_row is None:
        traffic = run_on(road(".......", ".>.....", "..>....", ".<.....", "...A...", "......."))
    error = refusal(traffic, Add(kind="barrier", count=1, where=Where(each="lane", row=row)))
    assert error.category == "occupied"
    assert error.facts.get("free_row") == free_row
    if free_row is not None:
        there = apply(traffic, Add(kind="barrier", count=1, where=Where(each="lane", row=free_row)))
        assert [thing.cell for thing in there.added] == [(column, free_row) for column in range(7)]


def test_a_row_that_is_half_closed_is_closed() -> None:
    closing = Add(kind="barrier", count=1, where=Where(each="lane", row=1))
    half = run_on(road(".......", "#.##...", ".......", ".......", "...A...", "......."))
    closed = apply(half, closing)
    assert [thing.cell for thing in closed.added] == [(1, 1), (4, 1), (5, 1), (6, 1)]
    assert refusal(closed.state, closing).code == "occupied"


@pytest.mark.parametrize(
    ("side", "cell"), [("ahead", (5, 0)), ("behind", (5, 2)), ("left", (4, 1)), ("right", (6, 1))]
)
def test_sides_are_seen_from_a_thing(side: str, cell: Cell) -> None:
    for of in (Landmark(kind="barrier", nearest=True), Landmark(id="barrier-1")):
        applied = apply(FULL, Add(kind="pothole", count=1, where=Where(side=side, of=of)))  # type: ignore[arg-type]
        assert applied.added[0].cell == cell


def test_half_of_them_and_all_but_some() -> None:
    half = apply(FULL, Remove(kind="pothole", count="half"))
    assert (len(half.removed), half.state.world.count(Kind.POTHOLE)) == (2, 2)
    assert apply(FULL, Remove(kind="pothole", count="half")).state == half.state, "drawn as before"
    rest = apply(FULL, Remove(kind="pothole", count="all", except_=NEAREST))
    assert cells_of(rest.state.world, Kind.POTHOLE) == {(3, 2)}
    left = apply(FULL, Remove(kind="everything", count="all", except_=Where(rows=(0, 1))))
    assert {thing.cell for thing in left.state.world.things()} == {(0, 0), (2, 1), (5, 1)}
    assert apply(EMPTY, Remove(kind="pothole", count="half")).state == EMPTY


# Growing and shrinking


@pytest.mark.parametrize(("parameter", "by"), [("columns", 2), ("columns", -1), ("rows", 3)])
def test_what_is_on_the_road_stays_when_the_road_changes_its_size(parameter: str, by: int) -> None:
    state = step(run_on(road("......", ".>.#..", "..o...", ").....", "...A..", "......"))).state
    applied = apply(state, Adjust(parameter=parameter, by=by))  # type: ignore[arg-type]
    world, farther = applied.state.world, by if parameter == "rows" else 0
    assert {thing.id: (thing.cell[0], thing.cell[1] - farther) for thing in world.things()} == {
        thing.id: thing.cell for thing in state.world.things()
    }
    assert (world.episode, world.tick, world.outcome) == (1, state.world.tick, Outcome.RUNNING)
    assert getattr(applied.state.config, parameter) == getattr(state.config, parameter) + by
    assert (world.road.columns, world.road.rows) == (applied.state.config.columns, applied.state.config.rows)
    assert not validate_world(world)
    assert step(applied.state).state.world.tick == world.tick + 1
    back = apply(applied.state, Adjust(parameter=parameter, by=-by))  # type: ignore[arg-type]
    assert back.state.world == state.world


def test_under_older_rules_another_size_is_another_road() -> None:
    state = SimState.start(Config(seed=4, rules=2))
    assert apply(state, Adjust(parameter="columns", by=1)).state.world.episode == 2


# While a result stands


def test_a_thing_of_the_road_that_has_ended_is_not_moved() -> None:
    state = SimState.start(Config(seed=6))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    shift = Shift(side="left")
    assert refusal(state, MoveThings(kind="vehicle", count=1, where=NEAREST, by=shift)).code == "road_is_gone"
    assert (
        refusal(state, Swap(first=OneThing(kind="vehicle"), second=OneThing(kind="pothole"))).code
        == "road_is_gone"
    )
    of = Landmark(kind="vehicle", nearest=True)
    assert (
        refusal(state, Add(kind="pothole", count=1, where=Where(side="behind", of=of))).code == "road_is_gone"
    )


# Anything at all

WHERES = st.builds(
    Where,
    lane=st.sampled_from([None, None, "left", "middle", 3]),
    lanes=st.none() | st.tuples(st.integers(1, 8), st.integers(1, 8)),
    rows=st.none() | st.tuples(st.integers(0, 10), st.integers(0, 10)),
    side=st.sampled_from([None, None, "ahead", "behind", "left", "right", "beside"]),
    cells=st.one_of(st.none(), st.integers(1, 4)),
    nearest=st.sampled_from([None, None, True]),
    id=st.sampled_from([None, None, None, "vehicle-1", "pothole-2", "av-1"]),
    each=st.sampled_from([None, None, None, "lane"]),
    of=st.sampled_from([None, None, Landmark(kind="vehicle", nearest=True), Landmark(id="barrier-1")]),
)
COUNTS = st.integers(1, 4) | st.just("all")
KIND = st.sampled_from(KINDS)
PLACES = st.none() | WHERES
ACTIONS = st.one_of(
    st.builds(MoveThings, kind=KIND, count=COUNTS, where=PLACES, to=WHERES),
    st.builds(
        MoveThings,
        kind=KIND,
        count=COUNTS,
        where=PLACES,
        by=st.builds(
            Shift, side=st.sampled_from(["ahead", "behind", "left", "right"]), cells=st.integers(1, 3)
        ),
    ),
    st.builds(
        Swap,
        first=st.builds(OneThing, kind=KIND, where=PLACES),
        second=st.builds(OneThing, kind=KIND, where=PLACES),
    ),
    st.builds(Replace, kind=KIND, count=COUNTS, where=PLACES, by=KIND),
    st.builds(Copy, kind=KIND, count=COUNTS, where=PLACES, to=PLACES),
    st.builds(Add, kind=KIND, count=st.integers(1, 3), where=PLACES),
    st.builds(Remove, kind=KIND, count=COUNTS | st.just("half"), where=PLACES, except_=PLACES),
    st.builds(Adjust, parameter=st.sampled_from(["columns", "rows"]), by=st.sampled_from([-2, -1, 1, 2])),
)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 99), st.lists(st.tuples(st.integers(0, 4), ACTIONS), max_size=8))
def test_any_change_is_done_wholly_or_refused_and_replays(
    seed: int, script: list[tuple[int, WorldAction]]
) -> None:
    timeline = Timeline(Config(columns=7, rows=10, seed=seed, pedestrians=2, barriers=3, potholes=5))
    for number, (ticks, action) in enumerate(script, 1):
        for _ in range(ticks):
            timeline.advance()
        before = timeline.state
        applied = tried(replace(before), action)
        if applied is None:
            continue
        after = applied.state
        assert not validate_world(after.world)
        sound(after.world)
        if not applied.events or applied.events[0].type is not EventType.EPISODE_STARTED:
            names = {thing.id for thing in before.world.things()}
            changed = names | {thing.id for thing in applied.added}
            assert {thing.id for thing in after.world.things()} == changed - {
                thing.id for thing in applied.removed
            }
        timeline.apply(number, [action])
        assert timeline.state.world.digest() == after.world.digest()
    for _ in range(3):
        timeline.advance()
    again = Timeline(timeline.config)
    for entry in timeline.entries:
        while again.tick < entry.tick:
            again.advance()
        again.apply(entry.sequence, [entry.action])
    while again.tick < timeline.tick:
        again.advance()
    assert again.state.world.digest() == timeline.state.world.digest()
