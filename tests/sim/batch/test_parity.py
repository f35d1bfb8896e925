"""The compiled engine is the live engine: same states every tick, same counts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.batch import Batch
from sim.config import Config
from sim.judge import collisions, outcome
from sim.kinds import Kind, Move, Outcome
from sim.run import Run, Tick, advance, commit
from sim.world import World
from tests.sim.batch.parity import difference, mixed_configs
from tests.sim.roads import run_on, worlds

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")

CONFIGS = list(mixed_configs(seed=1, count=240))


@pytest.mark.parametrize("group", range(len(CONFIGS)))
def test_mixed_roads_go_the_same_way(group: int) -> None:
    assert difference(CONFIGS[group], 120) is None


def test_the_largest_road() -> None:
    config = Config(columns=64, rows=512, pedestrians=50, potholes=300, courtesy=0.3)
    assert difference([config], 60) is None


@settings(max_examples=120)
@given(worlds(), st.sampled_from([0.0, 0.5]))
def test_any_moment_goes_on_the_same_way(world: World, courtesy: float) -> None:
    """Also with movers held by potholes, which no fresh road has."""
    run = run_on(world, courtesy=courtesy, reset_delay_s=1.0)
    batch = Batch.of([run])
    for _ in range(12):
        assert batch.digest(0) == run.world.digest()
        batch.run(1)
        run = advance(run).run


def moved(run: Run, move: Move) -> World:
    """The world after a move that nothing held back, judged."""
    after = commit(run.world, move, run.config)
    crashes = collisions(run.world, after)
    result = outcome(after, crashes, run.config.max_ticks)
    ended = None if result is Outcome.RUNNING else after.tick
    return replace(after, outcome=result, ended=ended)


@settings(max_examples=150)
@given(worlds(), st.sampled_from(list(Move)))
def test_any_move_ends_as_the_judge_says(world: World, move: Move) -> None:
    run = run_on(world)
    batch = Batch.of([run])
    batch.step(np.array([list(Move).index(move)], np.uint8))
    possible = world.road.moved(world.av, move) is not None
    assert batch.digest(0) == moved(run, move if possible else Move.STAY).digest()


def test_many_ticks_in_one_call_are_as_many_calls() -> None:
    configs = [Config(seed=seed, pedestrians=3) for seed in range(100)]
    once, often = Batch(configs), Batch(configs)
    once.run(150)
    for _ in range(150):
        often.run(1)
    assert [once.digest(lane) for lane in range(100)] == [often.digest(lane) for lane in range(100)]
    assert all((a == b).all() for a, b in zip(_rows(once), _rows(often), strict=True))


def test_threads_change_nothing() -> None:
    configs = [Config(seed=seed) for seed in range(500)]
    one, two = Batch(configs), Batch(configs)
    one.run(200)
    two.run(200, threads=2)
    assert all(one.digest(lane) == two.digest(lane) for lane in range(0, 500, 7))
    assert all((a == b).all() for a, b in zip(_rows(one), _rows(two), strict=True))


def _rows(batch: Batch) -> list[np.ndarray]:
    totals = batch.totals()
    return [getattr(totals, name) for name in totals.__slots__]


def test_a_restarting_lane_begins_its_first_road_at_once() -> None:
    config = Config(seed=4)
    batch = Batch([config], after="restart")
    first = batch.world(0)
    run, ticks = Run.start(config), 0
    while run.world.outcome is Outcome.RUNNING:
        run, ticks = advance(run).run, ticks + 1
    batch.run(ticks)
    begun = batch.world(0)
    assert (begun.av, begun.right, begun.left) == (first.av, first.right, first.left)
    assert int(batch.totals().successes[0]) + int(batch.totals().crashes[0]) == 1
    batch.run(ticks)
    assert batch.totals().forward[0] == 2 * run.metrics.forward


def test_a_stopping_batch_plays_one_episode_each() -> None:
    configs = [Config(seed=seed, potholes=20) for seed in range(300)]
    batch = Batch(configs, after="stop")
    batch.run_to_end()
    totals = batch.totals()
    assert ((totals.successes + totals.crashes + totals.stuck) == 1).all()
    for lane in range(0, 300, 29):
        run = Run.start(configs[lane])
        while run.world.outcome is Outcome.RUNNING:
            run = advance(run).run
        assert batch.outcomes[lane] == list(Outcome).index(run.world.outcome)
        assert totals.forward[lane] == run.metrics.forward
        if run.world.outcome is Outcome.SUCCESS:
            assert totals.ticks_to_goal[lane] == run.world.episode_tick


def test_roads_of_two_sizes_are_refused() -> None:
    with pytest.raises(ValueError, match="one size"):
        Batch([Config(), Config(rows=31)])


def test_moves_must_be_moves() -> None:
    batch = Batch([Config(), Config(seed=1)])
    with pytest.raises(ValueError, match="2 moves"):
        batch.step(np.zeros(3, np.uint8))
    with pytest.raises(ValueError, match="0 to 5"):
        batch.step(np.array([0, 6], np.uint8))
    assert (batch.episode_ticks == 0).all()


def test_a_lane_can_be_looked_at_as_a_world() -> None:
    world = Batch([Config(seed=3, pedestrians=2, barriers=2)]).world(0)
    counts = {kind: world.count(kind) for kind in (Kind.PEDESTRIAN, Kind.BARRIER)}
    assert counts == {Kind.PEDESTRIAN: 2, Kind.BARRIER: 2}
    assert len({thing.id for thing in world.things()}) == sum(world.counts().values())
    tick = advance(Run(Config(seed=3, pedestrians=2, barriers=2), world))
    assert isinstance(tick, Tick)
