"""What a person may put on the road and take from it: refusals in sentences, and nothing half done."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.actions import (
    Add,
    PlaceableKind,
    Remove,
    Reset,
    Scenario,
    SetCount,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.events import EventType
from sim.session.edits import Change, apply
from sim.state import SimState
from sim.transition import step
from sim.types import PLACEABLE, Cell, Kind
from tests.support.edits import EMPTY, FULL, KINDS, counts_of, refusal, sound
from tests.support.roads import grid, road, run_on

# Adding


@pytest.mark.parametrize("kind", KINDS)
def test_one_thing_in_a_cell_named(kind: PlaceableKind) -> None:
    applied = apply(EMPTY, Add(kind=kind, count=1, where=Where(cell=(5, 1))))
    (thing,) = applied.added
    assert (thing.id, thing.kind, thing.cell) == (f"{kind}-1", kind, (5, 1))
    assert applied.state.world.find(thing.id) == thing
    assert applied.changes == (Change(f"{kind}s", 0, 1),)
    assert (applied.removed, applied.events) == ((), ())
    assert (thing.heading is not None) is Kind(kind).moves
    sound(applied.state.world)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("where", "expected"),
    [
        (Where(lane="left"), {(0, row) for row in range(1, 5)}),
        (Where(lane=7), {(6, row) for row in range(1, 5)}),
        (Where(row=2), {(column, 2) for column in range(7)}),
        (Where(cells=2), {(column, 2) for column in range(7)}),
        (Where(side="ahead"), {(3, 3), (3, 2), (3, 1), (3, 0)}),
        (Where(side="right"), {(4, 4), (5, 4), (6, 4)}),
        (Where(side="ahead", lane=1, distance_m=10.0), {(0, 2), (0, 1), (0, 0)}),
        (None, {(column, row) for column in range(7) for row in range(1, 5)} - {(3, 4)}),
    ],
)
def test_several_things_go_where_they_were_said(
    kind: PlaceableKind, where: Where | None, expected: set[Cell]
) -> None:
    applied = apply(EMPTY, Add(kind=kind, count=3, where=where))
    assert len(applied.added) == applied.state.world.count(Kind(kind)) == 3
    assert {thing.cell for thing in applied.added} <= expected
    sound(applied.state.world)


@pytest.mark.parametrize(
    ("where", "expected"),
    [
        (Where(side="ahead"), [(3, 3), (3, 2)]),
        (Where(side="left"), [(2, 4), (1, 4)]),
        (Where(cells=1), [(3, 3), (2, 3)]),
        (Where(nearest=True), [(3, 3), (2, 3)]),
    ],
)
def test_what_is_seen_from_the_vehicle_is_filled_nearest_first(where: Where, expected: list[Cell]) -> None:
    applied = apply(EMPTY, Add(kind="pothole", count=2, where=where))
    assert sorted(thing.cell for thing in applied.added) == sorted(expected)


def test_several_things_go_round_what_is_there() -> None:
    applied = apply(FULL, Add(kind="barrier", count=5, where=Where(row=1)))
    assert len(applied.added) == 5
    assert grid(applied.state.world)[1] == "##>####"


def test_more_than_fit_are_refused_with_the_room_there_is() -> None:
    error = refusal(FULL, Add(kind="barrier", count=6, where=Where(row=1)))
    assert (error.category, error.field) == ("does-not-fit", "count")
    assert error.facts == {"count": 6, "kind": Kind.BARRIER, "free": 5, "place": "there"}


def test_three_hundred_potholes_do_not_fit_on_a_road_of_240_cells() -> None:
    state = SimState.start(Config(seed=1))
    room = 224 - state.world.moving.bit_count() - state.world.fixed.bit_count()
    error = refusal(state, Add(kind="pothole", count=300))
    assert (error.category, error.field) == ("does-not-fit", "count")
    assert error.facts == {
        "count": 300,
        "kind": Kind.POTHOLE,
        "free": room,
        "place": "between_start_and_goal",
    }
    error = refusal(state, SetCount(kind="pothole", count=300))
    assert error.category == "does-not-fit"
    assert error.facts["count"] == 300
    error = refusal(state, Scenario(potholes=300))
    assert (error.category, error.field) == ("does-not-fit", "potholes")
    full = apply(state, Add(kind="pothole", count=room)).state
    assert full.world.occupied & state.world.road.between == state.world.road.between
    assert refusal(full, Add(kind="vehicle", count=1)).facts["free"] == 0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("cell", "who"),
    [
        ((0, 2), "pothole-2"),
        ((5, 1), "barrier-1"),
        ((2, 1), "vehicle-1"),
        ((1, 3), "pedestrian-1"),
        ((3, 4), "av-1"),
    ],
)
def test_a_cell_that_is_taken(kind: PlaceableKind, cell: Cell, who: str) -> None:
    action = Add(kind=kind, count=1, where=Where(cell=cell))
    if kind == "pothole" and who in ("vehicle-1", "pedestrian-1"):
        assert apply(FULL, action).state.world.find(who).disabled  # type: ignore[union-attr]
        return
    error = refusal(FULL, action)
    assert (error.category, error.field) == ("occupied", "where")
    assert error.facts == {"column": cell[0], "row": cell[1], "id": who}


def test_a_pothole_under_a_mover_holds_it_and_the_log_says_so() -> None:
    applied = apply(FULL, Add(kind="pothole", count=1, where=Where(cell=(2, 1))))
    (event,) = applied.events
    assert (event.type, event.ids, event.cell) == (EventType.DISABLED, ("vehicle-1",), (2, 1))
    assert grid(applied.state.world)[1] == "..}..#."
    assert grid(step(applied.state).state.world)[1] == "..}..#."
    again = refusal(applied.state, Add(kind="pothole", count=1, where=Where(cell=(2, 1))))
    assert again.category == "occupied"
    freed = apply(applied.state, Remove(kind="pothole", count=1, where=Where(cell=(2, 1)))).state
    assert grid(step(freed).state.world)[1] == "...>.#."


def test_several_potholes_spare_the_movers() -> None:
    crowded = run_on(road(".....", "><.<>", "..A..", "....."))
    applied = apply(crowded, Add(kind="pothole", count=1, where=Where(row=1)))
    assert [thing.cell for thing in applied.added] == [(2, 1)]


@pytest.mark.parametrize(
    "where", [Where(lane=9), Where(row=60), Where(cell=(9, 9)), Where(cells=20), Where(side="left", cells=4)]
)
@pytest.mark.parametrize("count", [1, 2])
def test_places_off_the_road(where: Where, count: int) -> None:
    for action in (
        Add(kind="pothole", count=count, where=where),
        Remove(kind="pothole", count=count, where=where),
    ):
        error = refusal(FULL, action)
        assert (error.category, error.field) == ("outside-road", "where")


def test_other_autonomous_vehicles_are_not_available_yet() -> None:
    for action in (
        Add(kind="av", count=1),
        Remove(kind="av", count=1),
        SetCount(kind="av", count=2),
    ):
        error = refusal(EMPTY, action)
        assert (error.category, error.field) == ("not-available", "kind")
        assert error.code == "other_vehicles_not_available"


# Random places


def test_random_places_are_the_same_every_time_and_differ_from_edit_to_edit() -> None:
    state = SimState.start(Config(seed=9))
    five = Add(kind="pothole", count=5)
    first, again = apply(state, five), apply(state, five)
    assert first == again
    second = apply(first.state, five)
    removed = apply(first.state, Remove(kind="pothole", count=1, where=Where(id=first.added[0].id)))
    third = apply(removed.state, five)
    places = [{thing.cell for thing in applied.added} for applied in (first, second, third)]
    assert places[0] != places[1] != places[2]
    elsewhere = apply(replace(state, config=Config(seed=10)), five)
    assert {thing.cell for thing in elsewhere.added} != places[0]


def test_a_thing_elsewhere_moves_no_random_place_but_its_own() -> None:
    """A what-if without one barrier asks about the same potholes."""
    state = SimState.start(Config(seed=9, barriers=1))
    (barrier,) = (thing for thing in state.world.things() if thing.kind is Kind.BARRIER)
    bare = replace(state, world=state.world.without({barrier.id}))
    five = Add(kind="pothole", count=5)
    with_it = {thing.cell for thing in apply(state, five).added}
    without = {thing.cell for thing in apply(bare, five).added}
    assert len(with_it & without) >= 4


def test_movers_face_either_way() -> None:
    applied = apply(SimState.start(Config(seed=2, vehicles=0, potholes=0)), Add(kind="vehicle", count=100))
    right = sum(thing.heading == "right" for thing in applied.added)
    assert 30 < right < 70


# Removing


@pytest.mark.parametrize(
    ("action", "gone"),
    [
        # Nearest to the vehicle at (3, 4) first; among equals its own lane.
        (Remove(kind="pothole", count=1), [(3, 2)]),
        (Remove(kind="pothole", count=1, where=Where(nearest=True)), [(3, 2)]),
        (Remove(kind="pothole", count=2), [(3, 2), (5, 4)]),
        (Remove(kind="pothole", count="all"), [(3, 2), (5, 4), (0, 2), (0, 0)]),
        (Remove(kind="pothole", count=1, where=Where(lane="left")), [(0, 2)]),
        (Remove(kind="pothole", count="all", where=Where(lane=1)), [(0, 2), (0, 0)]),
        (Remove(kind="pothole", count=1, where=Where(row=0)), [(0, 0)]),
        (Remove(kind="pothole", count=1, where=Where(cell=(5, 4))), [(5, 4)]),
        (Remove(kind="pothole", count=1, where=Where(side="right")), [(5, 4)]),
        (Remove(kind="pothole", count=1, where=Where(side="right", distance_m=10.0)), [(5, 4)]),
        (Remove(kind="pothole", count=1, where=Where(cells=2)), [(3, 2)]),
        (Remove(kind="pothole", count=1, where=Where(id="pothole-1")), [(0, 0)]),
        (Remove(kind="vehicle", count=1, where=Where(side="behind")), [(2, 5)]),
        (Remove(kind="vehicle", count=1, where=Where(side="ahead")), [(2, 1)]),
        (Remove(kind="pedestrian", count=1), [(1, 3)]),
        (Remove(kind="everything", count="all", where=Where(row=1)), [(2, 1), (5, 1)]),
        (Remove(kind="everything", count=2), [(2, 5), (3, 2)]),
        (Remove(kind="everything", count=1, where=Where(id="vehicle-2")), [(2, 5)]),
        (Remove(kind="barrier", count="all", where=Where(lane="left")), []),
    ],
)
def test_what_is_removed(action: Remove, gone: list[Cell]) -> None:
    applied = apply(FULL, action)
    assert sorted(thing.cell for thing in applied.removed) == sorted(gone)
    left = {thing.id for thing in FULL.world.things()} - {thing.id for thing in applied.removed}
    assert {thing.id for thing in applied.state.world.things()} == left
    assert applied.added == ()
    sound(applied.state.world)


def test_removing_everything_leaves_the_vehicle_alone() -> None:
    applied = apply(FULL, Remove(kind="everything", count="all"))
    assert set(counts_of(applied.state.world)) == {0}
    assert applied.state.world.avs == FULL.world.avs
    assert {change.path for change in applied.changes} == {"potholes", "barriers", "vehicles", "pedestrians"}
    assert all(change.after == 0 for change in applied.changes)


@pytest.mark.parametrize(
    ("action", "code", "field", "facts"),
    [
        (
            Remove(kind="pothole", count=9),
            "too_few",
            "count",
            {"count": 4, "kind": "pothole", "place": "road"},
        ),
        (
            Remove(kind="barrier", count=2),
            "too_few",
            "count",
            {"count": 1, "kind": "barrier", "place": "road"},
        ),
        (
            Remove(kind="barrier", count=1, where=Where(lane="left")),
            "none_there",
            "kind",
            {"kind": "barrier", "place": "there"},
        ),
        (
            Remove(kind="everything", count=5, where=Where(row=1)),
            "too_few",
            "count",
            {"count": 2, "kind": "everything", "place": "there"},
        ),
        (
            Remove(kind="pothole", count=1, where=Where(id="pothole-77")),
            "no_such_thing",
            "where",
            {"id": "pothole-77"},
        ),
        (
            Remove(kind="pothole", count=1, where=Where(id="vehicle-1")),
            "of_another_kind",
            "where",
            {"id": "vehicle-1", "kind": "pothole"},
        ),
    ],
)
def test_what_cannot_be_removed(action: Remove, code: str, field: str, facts: dict[str, object]) -> None:
    error = refusal(FULL, action)
    assert (error.code, error.field, error.facts) == (code, field, facts)


def test_the_autonomous_vehicle_is_no_thing_to_be_removed() -> None:
    error = refusal(FULL, Remove(kind="everything", count=1, where=Where(id="av-1")))
    assert (error.code, error.facts) == ("of_another_kind", {"id": "av-1", "kind": "everything"})


# Exact numbers


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("count", [0, 1, 2, 7])
def test_exactly_so_many(kind: PlaceableKind, count: int) -> None:
    applied = apply(FULL, SetCount(kind=kind, count=count))
    was = FULL.world.count(Kind(kind))
    assert applied.state.world.count(Kind(kind)) == count
    assert applied.changes == (() if was == count else (Change(f"{kind}s", was, count),))
    assert (len(applied.added), len(applied.removed)) == (max(0, count - was), max(0, was - count))
    for other in PLACEABLE:
        if other != kind:
            assert applied.state.world.board(other) == FULL.world.board(other)
    sound(applied.state.world)


def test_as_many_as_there_are_is_no_change() -> None:
    assert apply(FULL, SetCount(kind="pothole", count=4)).state == FULL


# Ids


def test_ids_are_never_given_again() -> None:
    state, given = SimState.start(Config(seed=3)), set()
    actions: list[WorldAction] = [
        Add(kind="pothole", count=3),
        Remove(kind="pothole", count="all"),
        SetCount(kind="pothole", count=4),
        SetCount(kind="pothole", count=0),
        Reset(),
        Add(kind="pothole", count=2),
        Scenario(potholes=5, vehicles=2),
        Add(kind="vehicle", count=1),
    ]
    here = {thing.id for thing in state.world.things()}
    for action in actions:
        given |= here
        applied = apply(state, action)
        state = applied.state
        now = {thing.id for thing in state.world.things()}
        assert (now - here).isdisjoint(given)
        assert {thing.id for thing in applied.added} <= now - here
        assert {thing.id for thing in applied.removed} <= here
        here = now
        sound(state.world)
