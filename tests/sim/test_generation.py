"""Roads have what was asked for where it belongs, and one kind's number is no matter to another's places."""

from __future__ import annotations

from math import sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.config import Config
from sim.generation import generate
from sim.types import MOVERS, PLACEABLE, Kind
from sim.world.grid import bits

COUNTS = ("vehicles", "pedestrians", "barriers", "potholes")


@st.composite
def furnished(draw: st.DrawFn) -> Config:
    """A configuration of exact numbers that the road can hold."""
    columns, rows = draw(st.integers(3, 12)), draw(st.integers(4, 20))
    room = columns * (rows - 2)
    counts: dict[str, Any] = {}
    for name in COUNTS:
        counts[name] = draw(st.integers(0, room))
        room -= counts[name]
    return Config(columns=columns, rows=rows, seed=draw(st.integers(0, 2**50)), **counts)


@settings(max_examples=80, deadline=None)
@given(furnished(), st.integers(1, 99))
def test_exact_numbers_between_start_and_goal(config: Config, episode: int) -> None:
    world = generate(config, episode)
    for name, kind in zip(COUNTS, (Kind.VEHICLE, Kind.PEDESTRIAN, Kind.BARRIER, Kind.POTHOLE), strict=True):
        assert world.count(kind) == getattr(config, name)
    assert world.occupied.bit_count() == sum(world.counts().values()) + 1, "no two in a cell"
    assert (world.fixed | world.moving) & ~world.road.between == 0
    assert world.right & world.left == 0
    assert world.avs == (world.road.index((config.columns // 2, config.rows - 1)),)


@given(st.integers(0, 2**50))
def test_at_most_one_vehicle_and_one_pothole_a_row_when_drawn(seed: int) -> None:
    world = generate(Config(seed=seed), 1)
    for row in range(30):
        here = world.road.row(row)
        assert (world.board(Kind.VEHICLE) & here).bit_count() <= 1
        assert (world.potholes & here).bit_count() <= 1
    assert world.count(Kind.PEDESTRIAN) == world.count(Kind.BARRIER) == 0


@settings(max_examples=50)
@given(st.integers(0, 2**50), st.integers(0, 100))
def test_one_more_pothole_adds_one_and_moves_nothing(seed: int, potholes: int) -> None:
    fewer = generate(Config(seed=seed, potholes=potholes, barriers=3), 1)
    more = generate(Config(seed=seed, potholes=potholes + 1, barriers=3), 1)
    assert more.potholes & fewer.potholes == fewer.potholes
    assert more.potholes.bit_count() == potholes + 1
    assert (more.right, more.left, more.barriers) == (fewer.right, fewer.left, fewer.barriers)
    assert more.movers == fewer.movers


@settings(max_examples=50)
@given(st.integers(0, 2**50), st.integers(0, 60), st.integers(0, 60), st.integers(0, 60))
def test_one_more_vehicle_moves_no_other(seed: int, vehicles: int, pedestrians: int, potholes: int) -> None:
    def vehicles_of(count: int) -> tuple[int, int]:
        world = generate(
            Config(seed=seed, vehicles=count, pedestrians=pedestrians, potholes=potholes, rows=40), 1
        )
        return world.board(Kind.VEHICLE), world.right

    fewer, fewer_right = vehicles_of(vehicles)
    more, more_right = vehicles_of(vehicles + 1)
    assert fewer & more == fewer
    assert fewer_right & fewer == more_right & fewer


@given(st.integers(0, 2**50), st.one_of(st.none(), st.integers(0, 100)), st.floats(0, 1))
def test_pothole_settings_leave_the_traffic_as_it_is(seed: int, potholes: int | None, share: float) -> None:
    plain = generate(Config(seed=seed), 3)
    other = generate(Config(seed=seed, potholes=potholes, pothole_probability=share), 3)
    assert (other.right, other.left, other.movers) == (plain.right, plain.left, plain.movers)


def test_a_higher_probability_only_adds() -> None:
    for seed in range(40):
        some = generate(Config(seed=seed, spawn_probability=0.3), 1)
        more = generate(Config(seed=seed, spawn_probability=0.7), 1)
        assert some.moving & more.moving == some.moving


def within(share: float, probability: float, draws: int) -> bool:
    """Whether an observed share is within four standard errors."""
    return abs(share - probability) < 4 * sqrt(probability * (1 - probability) / draws)


def test_drawn_numbers_keep_to_their_probabilities() -> None:
    roads = [generate(Config(seed=seed), 1 + seed % 3) for seed in range(300)]
    rows = 28 * len(roads)
    movers = sum(world.moving.bit_count() for world in roads)
    assert within(movers / rows, 0.68, rows)
    assert within(sum(world.potholes.bit_count() for world in roads) / rows, 0.15, rows)
    assert within(sum(world.right.bit_count() for world in roads) / movers, 0.5, movers)
    for column in range(8):
        lane = roads[0].road.column(column)
        assert within(sum((world.moving & lane).bit_count() for world in roads) / movers, 1 / 8, movers)


def test_exact_numbers_are_spread_evenly_over_the_cells() -> None:
    times = [0] * 240
    for seed in range(300):
        for cell in bits(generate(Config(seed=seed, vehicles=0, potholes=28), 1).potholes):
            times[cell] += 1
    between = times[8:232]
    assert sum(between) == 300 * 28
    expected = 300 * 28 / 224
    chi = sum((count - expected) ** 2 / expected for count in between)
    assert chi < 304, "the 0.999 point of chi-square for 223 degrees of freedom, less drawing without return"


@pytest.mark.parametrize(("episode", "seed"), [(2, 0), (1, 1)])
def test_another_episode_or_seed_is_another_road(episode: int, seed: int) -> None:
    assert generate(Config(seed=seed), episode).moving != generate(Config(seed=0), 1).moving


def test_ids_go_on_from_those_given_and_count_in_reading_order() -> None:
    config = Config(seed=4, pedestrians=3, barriers=2)
    world = generate(config, 2, tick=50, numbered={Kind.POTHOLE: 7, Kind.BARRIER: 1})
    numbers = {
        kind: [int(world.id_at(cell, kind).rpartition("-")[2]) for cell in bits(world.board(kind))]
        for kind in PLACEABLE
    }
    for kind, first in ((Kind.POTHOLE, 8), (Kind.BARRIER, 2), (Kind.VEHICLE, 1), (Kind.PEDESTRIAN, 1)):
        assert numbers[kind] == list(range(first, first + world.count(kind)))
        assert world.numbered[kind] == numbers[kind][-1]
    assert set(world.movers) == set(bits(world.moving))
    assert set(world.hazards) == set(bits(world.fixed))
    assert all(name.startswith(MOVERS) for name in world.movers.values())
    assert (world.tick, world.episode_start, world.episode) == (50, 50, 2)


def test_a_full_road_is_full() -> None:
    world = generate(Config(columns=3, rows=4, vehicles=2, pedestrians=1, barriers=1, potholes=2), 1)
    assert world.fixed | world.moving == world.road.between
