"""A world is a value: things can be found, taken away, kept, and told apart by digest."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.types import PLACEABLE, Kind, Outcome
from sim.world import Thing, World
from sim.world.boards import Boards
from sim.world.grid import bits
from tests.support.roads import road, worlds

ROAD = road(
    "....",
    "o>.}",
    "#(.]",
    "..A.",
)


def test_things_are_told_kind_by_kind_in_reading_order() -> None:
    assert list(ROAD.things()) == [
        Thing("pothole-1", Kind.POTHOLE, (0, 1)),
        Thing("pothole-2", Kind.POTHOLE, (3, 1)),
        Thing("pothole-3", Kind.POTHOLE, (3, 2)),
        Thing("barrier-1", Kind.BARRIER, (0, 2)),
        Thing("vehicle-1", Kind.VEHICLE, (1, 1), "right"),
        Thing("vehicle-2", Kind.VEHICLE, (3, 1), "right", disabled=True),
        Thing("pedestrian-1", Kind.PEDESTRIAN, (1, 2), "left"),
        Thing("pedestrian-2", Kind.PEDESTRIAN, (3, 2), "right", disabled=True),
    ]


def test_counts() -> None:
    assert {kind: count for kind, count in ROAD.counts().items() if count} == {
        Kind.POTHOLE: 3,
        Kind.BARRIER: 1,
        Kind.VEHICLE: 2,
        Kind.PEDESTRIAN: 2,
    }
    assert list(ROAD.counts()) == list(PLACEABLE)
    assert ROAD.count(Kind.AV) == 1


@given(worlds())
def test_every_thing_is_found_by_its_id(world: World) -> None:
    things = list(world.things())
    assert len({thing.id for thing in things}) == len(things)
    for thing in things:
        assert world.find(thing.id) == thing
        assert world.id_at(world.road.index(thing.cell), thing.kind) == thing.id
    assert world.find("av-1") == Thing("av-1", Kind.AV, world.road.cell(world.av))


@pytest.mark.parametrize(
    "name", ["vehicle-9", "pothole-0", "av-2", "av-0", "av-", "", "-1", "vehicle", "tree-1", "av-x"]
)
def test_what_is_not_there_is_not_found(name: str) -> None:
    assert ROAD.find(name) is None


def test_an_id_is_found_only_as_it_is_written() -> None:
    assert ROAD.find("av-01") is None


def test_there_is_no_id_where_there_is_no_such_thing() -> None:
    with pytest.raises(KeyError):
        ROAD.id_at(0, Kind.POTHOLE)


def boards(world: World) -> dict[Kind, int]:
    return {kind: world.board(kind) for kind in PLACEABLE}


@settings(max_examples=80)
@given(worlds(), st.data())
def test_without_and_keeping_part_the_road_in_two(world: World, data: st.DataObject) -> None:
    ids = sorted(thing.id for thing in world.things())
    some = set(data.draw(st.lists(st.sampled_from(ids), unique=True))) if ids else set()
    rest, kept = world.without(some), world.keeping(some)
    assert {thing.id for thing in rest.things()} == set(ids) - some
    assert {thing.id for thing in kept.things()} == some
    for kind in PLACEABLE:
        assert boards(rest)[kind] | boards(kept)[kind] == boards(world)[kind]
        assert boards(rest)[kind] & boards(kept)[kind] == 0
    for part in (rest, kept):
        assert part.right & part.left == 0
        assert part.avs == world.avs
        assert part.numbered == world.numbered, "an id taken away is not given again"
        assert set(part.movers) == set(bits(part.moving))
        assert set(part.hazards) == set(bits(part.fixed))
    assert world.without({"pothole-999", "av-1"}) == world


def test_a_mover_is_free_again_without_its_pothole() -> None:
    freed = ROAD.without({"pothole-2"}).find("vehicle-2")
    assert freed is not None
    assert not freed.disabled


@settings(max_examples=80)
@given(worlds(), worlds())
def test_equal_digests_are_equal_states(one: World, other: World) -> None:
    assert one.digest() == replace(one, movers={}, hazards={}, numbered={}).digest()
    same = replace(one, movers={}, hazards={}, numbered={}) == replace(
        other, movers={}, hazards={}, numbered={}
    )
    assert (one.digest() == other.digest()) is same


@pytest.mark.parametrize(
    "difference",
    [
        {"tick": 1},
        {"episode": 2},
        {"episode_start": 1},
        {"outcome": Outcome.STUCK},
        {"avs": (13,)},
        {"avs": (14, 13)},
        {"boards": ROAD.boards.with_kind(Kind.POTHOLE, ROAD.potholes | 1)},
        {"boards": ROAD.boards.with_kind(Kind.BARRIER, ROAD.barriers | 1)},
        {"right": ROAD.right | 1},
        {"left": ROAD.left | 1},
        {"boards": ROAD.boards.with_kind(Kind.PEDESTRIAN, 0)},
        {"boards": Boards.in_order((ROAD.barriers, ROAD.potholes, *ROAD.boards.by_kind[2:]))},
        {"right": ROAD.left, "left": ROAD.right},
        {"outcome": Outcome.STUCK, "ended": 0},
    ],
)
def test_the_digest_sees_every_difference(difference: dict[str, object]) -> None:
    other = replace(ROAD, **difference)  # type: ignore[arg-type]
    assert other.digest() != ROAD.digest()


def test_the_digest_sees_when_a_result_was_decided() -> None:
    """It decides when the next episode begins, so it is part of the state."""
    one, other = (replace(ROAD, tick=9, outcome=Outcome.STUCK, ended=ended) for ended in (6, 8))
    assert one.digest() != other.digest()


def test_the_digest_is_frozen() -> None:
    """Recordings carry digests: this value may change only with a new version of the recording."""
    assert ROAD.digest() == "fe18865d2d1d69c8d9a80bf343f21b0e"
    assert len(ROAD.digest()) == 32
