"""The environments keep Gymnasium's contract, and are the same world as everything else."""

from __future__ import annotations

import doctest
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import sim.env
from sim.config import Config
from sim.env import RoadEnv, RoadVectorEnv
from sim.env.observation import PLANES
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")


class OneLane(gymnasium.Env[Any, Any]):
    """A vector environment of one lane in the form of a single one, for the checker that there is."""

    def __init__(self, **arguments: Any) -> None:
        self.many = RoadVectorEnv(1, {"rows": 10, "potholes": 5}, **arguments)
        self.metadata = {"render_modes": []}
        self.observation_space = self.many.single_observation_space
        self.action_space = self.many.single_action_space

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, Any]:
        super().reset(seed=seed, options=options)
        observations, info = self.many.reset(seed=seed, options=options)
        return observations[0], {key: value[0] for key, value in info.items()}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        observations, paid, ended, cut, info = self.many.step(np.array([action]))
        told = {key: value[0] for key, value in info.items()}
        return observations[0], float(paid[0]), bool(ended[0]), bool(cut[0]), told


def made(config: dict[str, Any], render_mode: str) -> gymnasium.Env[Any, Any]:
    return gymnasium.make("Roadtalk-v0", config=config, render_mode=render_mode).unwrapped


@pytest.mark.parametrize(
    "env",
    [
        lambda: gymnasium.make("Roadtalk-v0").unwrapped,
        lambda: made({"columns": 3, "rows": 4, "vehicles": 0, "potholes": 0}, "ansi"),
        lambda: made({"pedestrians": 4, "courtesy": 0.5}, "rgb_array"),
        OneLane,
    ],
    ids=["default", "smallest", "pictures", "vector"],
)
def test_the_checker_finds_nothing(env: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checked = env()
        check_env(checked, skip_render_check=isinstance(checked, OneLane))


@pytest.mark.parametrize("observation", ["planes", "image", "image_first"])
@pytest.mark.parametrize("window", [None, (6, 1, 3)])
@pytest.mark.parametrize("action_mask", [True, False])
@pytest.mark.parametrize("rewards", [{}, {"progress_reward": 0, "goal_reward": 10, "discount": 0.99}])
def test_the_checker_finds_nothing_with_any_options(
    observation: str, window: Any, action_mask: bool, rewards: dict[str, Any]
) -> None:
    arguments = {"observation": observation, "window": window, "action_mask": action_mask, **rewards}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make("Roadtalk-v0", config={"rows": 10}, **arguments).unwrapped)
        check_env(OneLane(**arguments), skip_render_check=True)


@pytest.mark.parametrize("parts", [{}, {"potholes": 30, "pedestrians": 3}, {"columns": 20, "rows": 6}])
def test_many_are_as_many_single_ones(parts: dict[str, Any]) -> None:
    """Step by step, through several episodes: against Gymnasium's own loop over single environments."""
    one_by_one = SyncVectorEnv([lambda: RoadEnv(parts)] * 5, autoreset_mode=AutoresetMode.NEXT_STEP)
    together = RoadVectorEnv(5, parts)
    seen, _ = one_by_one.reset(seed=11)
    shown, _ = together.reset(seed=11)
    draw, ends = np.random.default_rng(0), 0
    for _ in range(120):
        assert (seen == shown).all()
        actions = draw.choice(6, 5, p=[0.5, 0.1, 0.1, 0.1, 0.1, 0.1])
        seen, paid, ended, cut, _ = one_by_one.step(actions)
        shown, earned, finished, stopped, _ = together.step(actions)
        assert np.allclose(paid, earned)
        assert (ended == finished).all()
        assert (cut == stopped).all()
        ends += int(ended.sum())
    assert ends > 5


def test_episodes_are_reproducible_by_seed() -> None:
    env = RoadEnv({"potholes": 20})
    runs = []
    for _ in range(2):
        first, _ = env.reset(seed=42)
        trail = [first.tobytes()]
        for action in [0, 0, 1, 0, 2, 5, 3, 4, 0, 0]:
            observation, _, ended, cut, _ = env.step(action)
            trail.append(observation.tobytes())
            if ended or cut:
                break
        runs.append(trail)
    assert runs[0] == runs[1]
    assert env.reset(seed=43)[0].tobytes() != runs[0][0]
    following, info = env.reset()
    assert info["episode_number"] == 2
    assert following.tobytes() != runs[0][0]


def test_it_is_the_world_that_the_planners_drive_in() -> None:
    config = Config(seed=7, potholes=12)
    env, state = RoadEnv({"potholes": 12}), SimState.start(config)
    env.reset(seed=7)
    total = 0.0
    while state.world.outcome is Outcome.RUNNING:
        tick = step(state)
        assert tick.decision is not None
        _, reward, ended, _, _ = env.step(list(Move).index(tick.decision.move))
        total += reward
        state = tick.state
    assert ended == (state.world.outcome is not Outcome.STUCK)
    if state.world.outcome is Outcome.SUCCESS:
        assert total == pytest.approx(2 - 2 * state.world.episode_tick / config.max_ticks)


def test_what_cannot_be_is_said() -> None:
    env = RoadEnv()
    with pytest.raises(RuntimeError, match="reset first"):
        env.step(0)
    with pytest.raises(RuntimeError, match="reset first"):
        RoadVectorEnv(2).step(np.zeros(2, np.int64))
    with pytest.raises(ValueError, match="render mode"):
        RoadEnv(render_mode="smell")
    env.reset(seed=0)
    ended = cut = False
    while not (ended or cut):
        _, _, ended, cut, _ = env.step(5)
    with pytest.raises(RuntimeError, match="has ended"):
        env.step(5)


def test_it_can_be_made_by_name() -> None:
    assert "Roadtalk-v0" in gymnasium.registry
    assert sim.env.RoadEnv is RoadEnv
    assert type(gymnasium.make("Roadtalk-v0").unwrapped) is RoadEnv
    many = gymnasium.make_vec("Roadtalk-v0", num_envs=3, config={"rows": 12})
    assert type(many) is RoadVectorEnv
    observations, _ = many.reset(seed=1)
    assert observations.shape == (3, PLANES, 12, 8)
    many.close()


def test_the_examples_are_so() -> None:
    page = Path(__file__).parents[3] / "docs" / "reference" / "environments.md"
    results = doctest.testfile(str(page), module_relative=False, encoding="utf-8")
    assert (results.failed, results.attempted > 6) == (0, True)
