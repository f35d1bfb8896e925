"""What is given to an environment is taken as it is meant, or refused in words that help."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest

from sim.config import ConfigError
from sim.env import RoadEnv, RoadVectorEnv
from sim.generation import GenerationError
from sim.randomness import MAX_SEED

pytestmark = pytest.mark.xdist_group("compiled")

both = pytest.mark.parametrize(
    "make",
    [
        RoadEnv,
        RoadVectorEnv,
        lambda **arguments: gymnasium.make("Roadtalk-v0", **arguments),
        lambda **arguments: gymnasium.make_vec("Roadtalk-v0", num_envs=2, **arguments),
    ],
    ids=["one", "many", "made", "made_vec"],
)


@both
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"obsrvation": "image"}, r"'obsrvation'; did you mean observation\?.*It takes .*window"),
        ({"potholes": 10}, r"'potholes'; did you mean config=\{'potholes': …\}\?"),
        ({"smell": True}, r"no argument 'smell'.*It takes action_mask, .*config"),
    ],
)
def test_unknown_arguments_are_named(make: Callable[..., Any], arguments: Any, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        make(**arguments)


@both
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"observation": "imag"}, r"no observation 'imag'; did you mean 'image'\?"),
        ({"window": (3, 1)}, "rows ahead, rows behind, columns on either side"),
        ({"window": (3, -1, 2)}, "rows behind must be at least 0"),
        ({"window": (3, 1.5, 2)}, "rows behind must be a whole number"),
        ({"crash_penalty": -1}, "crash_penalty must be at least 0, not -1"),
        ({"goal_reward": "high"}, "goal_reward must be a finite number, not 'high'"),
        ({"step_cost": float("nan")}, "step_cost must be a finite number"),
        ({"action_mask": "no"}, "action_mask must be True or False, not 'no'"),
        ({"discount": 1.5}, "discount must be at most 1"),
        ({"config": {"seed": 3}}, "seed: is given to reset"),
        ({"config": {"pothole": 3}}, "pothole: not a setting.*potholes"),
    ],
)
def test_values_that_cannot_be_are_named(make: Callable[..., Any], arguments: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        make(**arguments)


def test_what_only_many_take_is_checked_too() -> None:
    with pytest.raises(ValueError, match="num_envs must be at least 1"):
        RoadVectorEnv(0)
    with pytest.raises(ValueError, match="threads must be a whole number"):
        RoadVectorEnv(1, threads=1.5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="no autoreset mode 'Never'"):
        RoadVectorEnv(1, autoreset_mode="Never")
    for make in (RoadEnv, RoadVectorEnv):
        with pytest.raises(ValueError, match=r"no render mode 'rgb'.*'ansi', 'rgb_array'"):
            make(render_mode="rgb")
    with pytest.raises(TypeError, match="config is a mapping"):
        RoadEnv(["potholes"])  # type: ignore[arg-type]
    with pytest.raises(ConfigError, match="columns"):
        RoadVectorEnv(2, {"columns": 1})


@pytest.mark.parametrize("env", [RoadEnv(), RoadVectorEnv(2)], ids=["one", "many"])
def test_options_of_a_reset_that_there_are_not_are_named(env: Any) -> None:
    with pytest.raises(ValueError, match="no option 'speed'"):
        env.reset(options={"speed": 3})
    env.reset(options={})


@pytest.mark.parametrize("make", [RoadEnv, RoadVectorEnv])
def test_a_road_that_cannot_be_had_is_told(make: Callable[..., Any]) -> None:
    walled = {"rows": 4, "columns": 3, "vehicles": 0, "potholes": 0, "barriers": 6, "solvable": True}
    with pytest.raises(GenerationError, match="no drivable road"):
        make(config=walled).reset(seed=0)


# Seeds


def first(seed: Any) -> tuple[bytes, int]:
    observation, info = RoadEnv().reset(seed=seed)
    return observation.tobytes(), info["seed"]


@pytest.mark.parametrize("kind", [np.int64, np.uint32, np.int8])
def test_numpy_integers_are_seeds(kind: Any) -> None:
    assert first(kind(7)) == first(7)
    many, _ = RoadVectorEnv(3).reset(seed=kind(7))
    assert many[0].tobytes() == first(7)[0]


def test_large_seeds_are_folded_the_same_everywhere() -> None:
    assert first(MAX_SEED)[1] == MAX_SEED
    large = [MAX_SEED + 1, 2**64 - 1, 2**64, 2**200]
    told = [first(seed)[1] for seed in large]
    assert len(set(told)) == len(large)
    assert all(0 <= seed <= MAX_SEED for seed in told)
    assert told == [first(seed)[1] for seed in large]
    assert told[0] == 3618076533414971  # a figure of numpy's SeedSequence, the same in all its versions
    _, many = RoadVectorEnv(2).reset(seed=MAX_SEED)
    assert many["seed"].tolist() == [MAX_SEED, told[0]]
    assert RoadVectorEnv(4).reset(seed=large)[1]["seed"].tolist() == told


@pytest.mark.parametrize("env", [RoadEnv(), RoadVectorEnv(2)], ids=["one", "many"])
def test_what_is_no_seed_is_refused(env: Any) -> None:
    for seed in (-1, np.int64(-5)):
        with pytest.raises(ValueError, match=r"0 or more, not .*-"):
            env.reset(seed=seed)
    for seed in (1.0, "7", True, np.float64(2)):
        with pytest.raises(TypeError, match="a seed is an integer"):
            env.reset(seed=seed)


def test_seeds_of_many_by_list() -> None:
    env = RoadVectorEnv(3)
    by_list, info = env.reset(seed=[5, 9, 5])
    assert info["seed"].tolist() == [5, 9, 5]
    assert (by_list[0] == by_list[2]).all()
    assert env.reset(seed=(5, np.int64(9), 5))[0].tobytes() == by_list.tobytes()
    assert env.reset(seed=np.array([5, 9, 5]))[0].tobytes() == by_list.tobytes()
    _, some = env.reset(seed=[None, 1, None])
    assert some["episode_number"].tolist() == [2, 1, 2]
    assert some["seed"].tolist() == [5, 1, 5]
    _, fresh = RoadVectorEnv(3).reset(seed=[None, 1, None])
    assert fresh["seed"][1] == 1
    assert fresh["episode_number"].tolist() == [1, 1, 1]
    with pytest.raises(ValueError, match="3 seeds are wanted"):
        env.reset(seed=[1, 2])
    with pytest.raises(ValueError, match="0 or more"):
        env.reset(seed=[1, -2, 3])
    with pytest.raises(TypeError, match="a seed is an integer"):
        env.reset(seed=[1, 2.0, 3])  # type: ignore[list-item]


def test_a_seed_gives_the_same_whatever_was_before() -> None:
    env = RoadVectorEnv(4)
    observations, _ = env.reset(seed=1)
    for _ in range(40):
        env.step(np.zeros(4, np.int64))
    assert env.reset(seed=1)[0].tobytes() == observations.tobytes()


# Actions


@pytest.mark.parametrize(
    "action", [6, -1, 255, 2**40, 1.0, np.float32(0), True, "0", None, [1], np.zeros(1, int)]
)
def test_what_is_no_action_is_refused(action: Any) -> None:
    env = RoadEnv()
    env.reset(seed=0)
    with pytest.raises(ValueError, match=r"a whole number from 0 to 5 .*, not "):
        env.step(action)
    assert env.step(5)[4]["tick"] == 1


@pytest.mark.parametrize("action", [2, np.int64(2), np.uint8(2), np.array(2)])
def test_integers_of_every_kind_are_actions(action: Any) -> None:
    env, other = RoadEnv(), RoadEnv()
    env.reset(seed=0)
    other.reset(seed=0)
    assert (env.step(action)[0] == other.step(2)[0]).all()


def test_what_are_no_actions_of_many_is_refused() -> None:
    env = RoadVectorEnv(3)
    env.reset(seed=0)
    for actions, words in (
        ([0, 6, 0], r"not 6 \(lane 1\)"),
        ([0, 0, -1], r"not -1 \(lane 2\)"),
        (np.array([0, 256, 0]), r"not 256 \(lane 1\)"),
        ([0.0, 1.0, 2.0], "whole number from 0 to 5"),
        ([True, False, True], "whole number from 0 to 5"),
        ([0, 1], r"the shape \(3,\)"),
        (np.zeros((3, 1), int), r"the shape \(3,\)"),
        (1, r"the shape \(3,\)"),
    ):
        with pytest.raises(ValueError, match=words):
            env.step(actions)  # type: ignore[arg-type]
    assert env.step(np.array([5, 5, 5], np.uint8))[4]["tick"].tolist() == [1, 1, 1]
