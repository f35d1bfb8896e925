"""A batch with sensors that err is the live engine with them: same states, beliefs and boards every tick."""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np
import pytest

from sim.batch import Batch
from sim.config import Config
from sim.env import RoadEnv, RoadVectorEnv
from sim.perceive.belief import LAYERS, GridBelief
from sim.sensor_names import BUILT_IN, DEFAULT_SENSOR
from sim.state import SimState
from sim.transition import step
from sim.types import MOVES, Outcome

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")

SENSORS = [name for name in BUILT_IN if name != DEFAULT_SENSOR]


def mixed(seed: int, count: int) -> list[Config]:
    """Configurations of one road size whose sensors, conditions and rules differ."""
    draw = Random(seed)
    columns, rows = ((8, 30), (8, 30), (5, 12), (21, 17), (64, 9), (8, 43))[seed % 6]
    return [
        Config(
            columns=columns,
            rows=rows,
            planner="priority",
            seed=draw.randrange(2**53),
            sensor=draw.choice(SENSORS),  # type: ignore[arg-type]
            weather=draw.choice(["clear", "rain", "fog"]),  # type: ignore[arg-type]
            time_of_day=draw.choice(["day", "night", "dawn"]),  # type: ignore[arg-type]
            detection_sensitivity=draw.choice([0.5, 0.8, 0.95, 0.05]),
            sensor_range_m=draw.choice([150.0, 40.0]),
            sensor_noise=draw.choice([0.0, 0.2]),
            false_positive_rate=draw.choice([0.0, 0.5]),
            potholes=draw.choice([None, 0, rows // 2]),
            barriers=draw.choice([0, rows // 3]),
            pedestrians=draw.choice([0, rows // 3]),
            courtesy=draw.choice([0.0, 0.5]),
            attentive=draw.choice([0.0, 0.5, 1.0]),
            collision=draw.choice(["swept", "cell"]),
            reset_delay_s=draw.choice([0.0, 1.0]),
        )
        for _ in range(count)
    ]


def assert_believed_alike(batch: Batch, lane: int, run: SimState) -> None:
    """As far as the row that the vehicle looked from."""
    belief, beliefs = run.ego().belief, batch._beliefs
    if not isinstance(belief, GridBelief) or run.world.outcome is not Outcome.RUNNING:
        return
    assert beliefs is not None
    road = run.world.road
    ahead = (int(beliefs.memory[lane, 0]) // road.columns + 1) * road.columns
    live = np.frombuffer(belief.layers, "<i2").reshape(LAYERS, -1)[:, :ahead]
    here = beliefs.layers[lane].reshape(LAYERS, -1)[:, :ahead]
    assert np.array_equal(live, here)


@pytest.mark.parametrize("seed", range(12))
def test_mixed_sensors_go_the_same_way(seed: int) -> None:
    configs = mixed(seed, 6)
    batch, runs = Batch(configs), [SimState.start(config) for config in configs]
    for _ in range(90):
        for lane, run in enumerate(runs):
            assert batch.digest(lane) == run.world.digest()
            assert_believed_alike(batch, lane, run)
        batch.run(1)
        runs = [step(run).state for run in runs]


@pytest.mark.parametrize("sensor", SENSORS)
def test_any_moment_goes_on_the_same_way(sensor: Any) -> None:
    run = SimState.start(Config(seed=3, sensor=sensor, weather="rain", potholes=12, planner="priority"))
    for _ in range(20):
        batch, after = Batch.of([run], after="stop"), run
        for _ in range(3):
            after = step(after).state
            batch.run(1)
            assert after.world.outcome is not Outcome.RUNNING or batch.digest(0) == after.world.digest()
        run = step(run).state
        if run.world.outcome is not Outcome.RUNNING:
            break


def test_moves_handed_in_are_sensed_as_well() -> None:
    """As live, where the sensors look whoever drives."""
    config = Config(seed=5, sensor="fusion", weather="rain", planner="priority")
    batch, run = Batch([config]), SimState.start(config)
    for tick in range(30):
        done = step(run)
        assert done.decision is not None
        assert MOVES[int(batch.moves("priority")[0])] is done.decision.move
        assert MOVES[int(batch.moves("priority")[0])] is done.decision.move, "asked twice"
        batch.step(np.array([MOVES.index(done.decision.move)], np.uint8))
        run = done.state
        if run.world.outcome is not Outcome.RUNNING:
            break
        assert batch.digest(0) == run.world.digest(), tick


def test_a_saved_batch_believes_what_it_believed() -> None:
    configs = [Config(seed=seed, sensor="fusion", weather="fog", potholes=15) for seed in range(70)]
    batch, other = Batch(configs, after="stop"), Batch(configs, after="stop")
    batch.run(12)
    batch.moves("priority")
    kept, twin = batch.saved(), batch.copy()
    batch.run_to_end()
    other.restore(kept)
    other.run_to_end()
    twin.run_to_end()
    wanted = [batch.digest(lane) for lane in range(70)]
    assert [other.digest(lane) for lane in range(70)] == wanted
    assert [twin.digest(lane) for lane in range(70)] == wanted


def test_threads_and_seeds_change_nothing() -> None:
    config = Config(sensor="camera", weather="snow", potholes=12)
    seeds = np.arange(200, dtype=np.int64)
    one, two = Batch.of_seeds(config, seeds), Batch([config.with_parts(seed=int(s)) for s in seeds])
    one.run(80, threads=2)
    two.run(80)
    assert all(one.digest(lane) == two.digest(lane) for lane in range(200))


def test_what_is_not_done_is_refused() -> None:
    sensed = Config(sensor="camera")
    with pytest.raises(ValueError, match="each in its own batch"):
        Batch([sensed, Config()])
    with pytest.raises(ValueError, match="next"):
        Batch([sensed], after="restart")
    with pytest.raises(ValueError, match="priority"):
        Batch([sensed]).run(1, "bfs")


def test_weather_is_nothing_to_the_perfect_sensor() -> None:
    fog, clear = Batch([Config(seed=1, weather="fog")]), Batch([Config(seed=1)])
    fog.run(40)
    clear.run(40)
    assert fog.digest(0) == clear.digest(0)


@pytest.mark.parametrize("seed", range(3))
def test_environments_side_by_side_see_what_one_sees(seed: int) -> None:
    config = {"sensor": "camera", "weather": "fog", "potholes": 12, "pedestrians": 4}
    many = RoadVectorEnv(num_envs=3, config=config)
    alone = [RoadEnv(config=config) for _ in range(3)]
    seen, _ = many.reset(seed=seed)
    for lane, env in enumerate(alone):
        assert np.array_equal(env.reset(seed=seed + lane)[0], seen[lane])
    running = [True] * 3
    draw = Random(seed)
    for _ in range(25):
        actions = np.array([draw.choice([0, 0, 0, 1, 2, 5]) for _ in range(3)])
        seen, _, ended, cut, _ = many.step(actions)
        for lane, env in enumerate(alone):
            if running[lane]:
                assert np.array_equal(env.step(int(actions[lane]))[0], seen[lane])
                running[lane] = not (ended[lane] or cut[lane])
