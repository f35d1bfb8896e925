"""One environment and many tell the same: against Gymnasium's own loop, in each of its autoreset modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import RecordEpisodeStatistics
from gymnasium.wrappers.vector import RecordEpisodeStatistics as RecordStatisticsOfMany

from sim.env import RoadEnv, RoadVectorEnv
from tests.support.alike import assert_alike

pytestmark = pytest.mark.xdist_group("compiled")

KEYS = {"outcome", "is_success", "tick", "episode_number", "seed", "action_mask"}
OFTEN_ENDING = {"rows": 8, "potholes": 12, "pedestrians": 2, "courtesy": 0.5}
LANES = 5


def both(mode: AutoresetMode, **arguments: Any) -> tuple[SyncVectorEnv, RoadVectorEnv]:
    made = [lambda: RoadEnv(OFTEN_ENDING, **arguments)] * LANES
    return (
        SyncVectorEnv(made, autoreset_mode=mode),
        RoadVectorEnv(LANES, OFTEN_ENDING, autoreset_mode=mode, **arguments),
    )


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("arguments", [{}, {"window": (3, 1, 2), "discount": 0.9}, {"observation": "image"}])
def test_many_are_as_many_single_ones_to_the_last_key(mode: AutoresetMode, arguments: Any) -> None:
    one_by_one, together = both(mode, **arguments)
    assert together.metadata["autoreset_mode"] is mode
    assert_alike(one_by_one.reset(seed=3), together.reset(seed=3))
    draw, ends = np.random.default_rng(1), 0
    for _ in range(80):
        actions = draw.integers(0, 6, LANES)
        expected, found = one_by_one.step(actions), together.step(actions)
        assert np.allclose(expected[1], found[1])
        assert_alike((expected[0], *expected[2:]), (found[0], *found[2:]))
        ends += int((found[2] | found[3]).sum())
        assert ("final_info" in found[4]) == (
            mode is AutoresetMode.SAME_STEP and bool((found[2] | found[3]).any())
        )
    assert ends > 10
    assert_alike(one_by_one.reset(), together.reset())
    seeds = [None, 7, None, 2**60, None]
    assert_alike(one_by_one.reset(seed=seeds), together.reset(seed=seeds))


def test_without_autoreset_the_ended_lanes_are_reset_by_mask() -> None:
    one_by_one, together = both(AutoresetMode.DISABLED)
    assert_alike(one_by_one.reset(seed=3), together.reset(seed=3))
    draw, resets = np.random.default_rng(2), 0
    for _ in range(60):
        actions = draw.integers(0, 6, LANES)
        expected, found = one_by_one.step(actions), together.step(actions)
        assert_alike((expected[0], *expected[2:]), (found[0], *found[2:]))
        ended = found[2] | found[3]
        if ended.any():
            with pytest.raises(RuntimeError, match="reset_mask"):
                together.step(actions)
            answers = [env.reset(options={"reset_mask": ended.copy()}) for env in (one_by_one, together)]
            assert_alike(*answers)
            resets += 1
    assert resets > 5


def test_the_keys_are_the_same_and_masked() -> None:
    _, told = RoadEnv().reset(seed=0)
    _, all_told = RoadVectorEnv(2).reset(seed=0)
    assert set(told) == KEYS
    assert set(all_told) == KEYS | {f"_{key}" for key in KEYS}
    assert told["seed"] == 0
    assert all_told["seed"].tolist() == [0, 1]
    assert "action_mask" not in RoadEnv(action_mask=False).reset(seed=0)[1]
    assert "action_mask" not in RoadVectorEnv(2, action_mask=False).reset(seed=0)[1]


def test_what_was_returned_is_not_changed_later() -> None:
    env = RoadVectorEnv(3, OFTEN_ENDING)
    observations, info = env.reset(seed=0)
    kept = observations.copy(), {key: value.copy() for key, value in info.items()}
    for _ in range(5):
        env.step(np.zeros(3, np.int64))
    assert_alike((observations, info), kept)


def test_reset_masks_that_cannot_be_are_refused() -> None:
    env = RoadVectorEnv(2)
    with pytest.raises(RuntimeError, match="reset first"):
        env.reset(options={"reset_mask": np.array([True, False])})
    env.reset(seed=0)
    with pytest.raises(TypeError, match="array of bool"):
        env.reset(options={"reset_mask": [True, False]})
    for mask in ([True], [False, False]):
        with pytest.raises(ValueError, match="shape"):
            env.reset(options={"reset_mask": np.array(mask)})


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_wrappers_that_count_episodes_find_their_key_free(mode: AutoresetMode) -> None:
    """Gymnasium and Stable-Baselines3 put figures of an ended episode under `episode`."""
    env = RecordEpisodeStatistics(RoadEnv(OFTEN_ENDING))
    env.reset(seed=0)
    ended, total = False, 0.0
    while not ended:
        _, paid, one, two, info = env.step(np.int64(0))
        ended = one or two
        assert ("episode" in info) is ended
        total += float(paid)
    assert info["episode"]["r"] == pytest.approx(total)
    many = RecordStatisticsOfMany(RoadVectorEnv(LANES, OFTEN_ENDING, autoreset_mode=mode))
    many.reset(seed=0)
    counted = 0
    for _ in range(30):
        _, _, ones, twos, info = many.step(np.zeros(LANES, np.int64))
        assert ("episode" in info) is bool((ones | twos).any())
        counted += int(info["_episode"].sum()) if "episode" in info else 0
    assert counted > 5
