"""Families of roads: the same on every machine, drivable, exact in what is asked for, hard to some."""

from __future__ import annotations

from statistics import fmean
from typing import get_args

import pytest

from sim.actions import Layout, Preference, Scenario
from sim.batch import Batch
from sim.config import RANGES, Config, ConfigError
from sim.generation import GenerationError, generate
from sim.oracle import Drivable, certify, least_ticks
from sim.oracle.lower_bounds import can_arrive
from sim.randomness import Stream
from sim.session.config_to_actions import config_to_actions
from sim.session.scenario import config_of_scenario
from sim.state import SimState, next_episode
from sim.transition import step
from sim.types import Outcome
from sim.validation import validate_world
from sim.world import World
from sim.world.grid import Road
from sim.world.layouts import has_barriers, lay_out, min_free_cells, vehicles_on_average

LAYOUTS: tuple[Layout, ...] = get_args(Layout)
SIZES = ((3, 4), (3, 512), (64, 4), (64, 512), (5, 5), (8, 30), (17, 90))

PINNED = {
    "walls": ("500b1b1a8246e301", "6250d040c2e7f5bd", "4c268949160350a7"),
    "narrows": ("ce3bed57a11066a5", "3c70d78092417e2a", "882f73f91fb7091b"),
    "dead_ends": ("26b41445c899338c", "7b991f82b1032c3a", "848b810d82b156dd"),
    "crossing": ("80e249187dbdd023", "b40ed9c949a02e93", "8c49c54f423d1c21"),
    "maze": ("7f236631ae434dc6", "97d6c90a616e7e00", "44d444da489c7c28"),
}
"""The first 16 digits of a first road's digest, of seeds 1, 2 and 3."""


@pytest.mark.parametrize("layout", LAYOUTS)
def test_roads_are_the_same_on_every_machine(layout: Layout) -> None:
    digests = tuple(generate(Config(layout=layout, seed=seed), 1).digest()[:16] for seed in (1, 2, 3))
    assert digests == PINNED[layout]


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("size", SIZES)
def test_any_size_of_road_is_sound_and_drivable(layout: Layout, size: tuple[int, int]) -> None:
    columns, rows = size
    state = SimState.start(Config(layout=layout, columns=columns, rows=rows, seed=columns + rows))
    world = state.world
    assert validate_world(world) == ()
    everything = world.fixed | world.right | world.left
    assert not everything & (world.road.row(0) | world.road.row(rows - 1))
    assert can_arrive(state)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_longer_road_goes_on_from_a_shorter_one(layout: Layout) -> None:
    """Bands are drawn one by one from the start, each from its own stream."""
    stream = Stream.of(5, f"layout {layout}", 1)
    short, long = lay_out(layout, Road.of(8, 20), stream), lay_out(layout, Road.of(8, 50), stream)
    below_goal = Road.of(8, 20).all & ~Road.of(8, 20).row(0)
    for one, other in zip(short, long, strict=True):
        assert one & below_goal == other >> 8 * 30 & below_goal


@pytest.mark.parametrize("layout", LAYOUTS)
def test_what_is_asked_for_is_exact_and_moves_no_barrier(layout: Layout) -> None:
    for seed in range(20):
        plain = generate(Config(layout=layout, seed=seed, solvable=True), 1)
        config = Config(layout=layout, seed=seed, vehicles=9, pedestrians=3, potholes=5)
        world = generate(config, 1)
        counts = world.counts()
        assert (counts["vehicle"], counts["pedestrian"], counts["pothole"]) == (9, 3, 5)
        if has_barriers(layout):
            # Either of them may have been drawn again, from another stream.
            assert world.barriers.bit_count() > 20 or layout == "dead_ends"
            empty = Config(layout=layout, seed=seed, vehicles=0, potholes=0)
            assert generate(empty, 1).barriers == first_barriers(empty)
        else:
            assert not plain.barriers


def first_barriers(config: Config) -> int:
    """The barriers of the first draw."""
    return lay_out(
        config.layout, config.geometry, Stream.of(config.seed, f"layout {config.layout}", 1)
    ).barriers


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("size", SIZES)
def test_there_is_as_much_room_as_is_promised(layout: Layout, size: tuple[int, int]) -> None:
    road = Road.of(*size)
    promised = min_free_cells(layout, *size)
    for seed in range(3 if size == (64, 512) else 40):
        barriers = lay_out(layout, road, Stream.of(seed, "room")).barriers
        assert not barriers & ~road.between
        assert (road.between & ~barriers).bit_count() >= promised > 0
    if promised >= RANGES["potholes"][1]:
        return
    with pytest.raises(ConfigError, match=rf"too many \(room={promised}\)"):
        Config(layout=layout, columns=size[0], rows=size[1], vehicles=0, potholes=promised + 1)


@pytest.mark.parametrize("layout", ["walls", "crossing"])
def test_more_than_can_be_driven_through_is_refused_in_words(layout: Layout) -> None:
    room = min_free_cells(layout, 3, 5)
    with pytest.raises(GenerationError, match="no drivable road"):
        SimState.start(Config(layout=layout, columns=3, rows=5, vehicles=0, potholes=room))


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if has_barriers(layout)])
def test_barriers_beside_a_layout_of_barriers_are_refused(layout: Layout) -> None:
    with pytest.raises(ConfigError) as refused:
        Config(layout=layout, barriers=1)
    assert [problem.field for problem in refused.value.problems] == ["barriers"]
    for barriers in (0, 3):
        with pytest.raises(ConfigError, match=rf"must not be counted \(layout={layout}\)"):
            config_of_scenario(Config(), Scenario(layout=layout, barriers=barriers))
    assert config_of_scenario(Config(), Scenario(layout=layout, road="city")).barriers == 0


def test_crossing_traffic_has_the_barriers_that_are_asked_for() -> None:
    world = generate(Config(layout="crossing", barriers=4), 1)
    assert world.barriers.bit_count() == 4


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_scenario_names_a_layout_and_a_configuration_is_described(layout: Layout) -> None:
    config = config_of_scenario(Config(seed=3), Scenario(layout=layout, road="city", potholes=2))
    assert (config.layout, config.road, config.pedestrians, config.potholes) == (layout, "city", 4, 2)
    assert Scenario(layout=layout, road="city", potholes=2) in config_to_actions(config)
    assert config_of_scenario(config, Scenario()).layout is None


@pytest.mark.parametrize("layout", LAYOUTS)
def test_traffic_fills_a_layout_as_it_fills_a_road(layout: Layout) -> None:
    def vehicles(probability: float) -> float:
        configs = [Config(layout=layout, seed=seed, spawn_probability=probability) for seed in range(60)]
        return fmean(generate(config, 1).counts()["vehicle"] for config in configs)

    assert vehicles(0.0) == 0
    assert vehicles(0.3) < vehicles(0.68) < vehicles(0.9)
    assert vehicles(0.68) == pytest.approx(vehicles_on_average(layout, 8, 30, 0.68), rel=0.15)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_two_hundred_roads_of_a_family_are_drivable_and_ask_for_more_than_going_straight(
    layout: Layout,
) -> None:
    """Every certificate is a plan that was played; the families lengthen the way.

    What needs nobody to brake is a way where all do, too.
    """
    lengths, first_draws = [], 0
    for seed in range(200):
        config = Config(layout=layout, seed=seed, attentive=0.0)
        state = SimState.start(config)
        certificate = certify(state)
        assert isinstance(certificate, Drivable)
        lengths.append(certificate.ticks)
        first_draws += not has_barriers(layout) or state.world.barriers == first_barriers(config)
    assert first_draws >= 190
    assert fmean(lengths) - (config.rows - 1) > {"crossing": 1.2}.get(layout, 2.5)


def test_scattered_roads_are_hardly_longer_than_going_straight() -> None:
    configs = [Config(seed=seed, solvable=True, attentive=0.0) for seed in range(200)]
    lengths = [least_ticks(SimState.start(config)) or 0 for config in configs]
    assert fmean(lengths) - 29 < 0.1


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_planner_that_looks_ahead_and_one_that_does_not_come_apart(layout: Layout) -> None:
    arrived, late = 0, []
    for seed in range(40):
        state = SimState.start(Config(layout=layout, seed=seed, planner="priority", attentive=0.0))
        least = least_ticks(state)
        assert least is not None
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        if state.world.outcome is Outcome.SUCCESS:
            arrived += 1
            late.append(state.world.episode_tick - least)
    assert arrived <= 30 or fmean(late) > 8


@pytest.mark.parametrize("layout", LAYOUTS)
def test_neither_side_is_favoured(layout: Layout) -> None:
    """Barriers by column against the mirror image, where no column of the start takes part."""
    columns, seeds = 9, 400
    road = Road.of(columns, 30)
    counts = [0] * columns
    for seed in range(seeds):
        barriers = lay_out(layout, road, Stream.of(seed, "mirror")).barriers
        for column in range(columns):
            counts[column] += (barriers & road.column(column)).bit_count()
    for left, right in zip(counts, reversed(counts), strict=True):
        assert abs(left - right) <= 0.06 * max(left + right, 1)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_episode_is_another_road_of_the_family(layout: Layout) -> None:
    state = SimState.start(Config(layout=layout, seed=4))
    following, _ = next_episode(state)
    assert following.config.layout == layout
    assert following.world.digest() != state.world.digest()
    assert certified(following.world, following.config)


def certified(world: World, config: Config) -> bool:
    """Whether a road can be driven."""
    return isinstance(certify(SimState(config, world)), Drivable)


def test_a_batch_takes_roads_of_a_layout_from_runs() -> None:
    configs = [Config(layout=layout, seed=seed, solvable=True) for layout in LAYOUTS for seed in range(3)]
    with pytest.raises(ValueError, match=r"Batch\.of"):
        Batch(configs, after="stop")
    runs = [SimState.start(config) for config in configs]
    with pytest.raises(ValueError, match=r"Batch\.of"):
        Batch.of(runs)
    batch = Batch.of(runs, after="stop")
    assert batch.configs == configs
    assert [batch.digest(lane) for lane in range(len(runs))] == [state.world.digest() for state in runs]
    restarting = Batch.of(runs, after="restart")
    restarting.run(400)
    assert (restarting.episodes == 1).all()


def ticks(seed: int, layout: Layout | None, *preferences: Preference) -> int:
    """How long `astar` takes on a first road."""
    state = SimState.start(Config(layout=layout, seed=seed, planner="astar", preferences=preferences))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    assert state.world.outcome is Outcome.SUCCESS
    return state.world.episode_tick


@pytest.mark.parametrize("layout", ["walls", "maze"])
def test_who_asks_for_the_fastest_way_gets_there_sooner(layout: Layout) -> None:
    """The figures with intervals are in bench/FAMILIES.md."""
    saved = [ticks(seed, layout) - ticks(seed, layout, "fastest") for seed in range(8)]
    assert min(saved) >= 0
    assert sum(saved) > 0
