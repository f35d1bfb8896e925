"""Masks tell exactly which moves end in a collision in the coming tick, or lead off the road."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sim.env import RoadEnv, RoadVectorEnv
from sim.perceive.observe import VEHICLE
from sim.types import Move

pytestmark = pytest.mark.xdist_group("compiled")

ROADS: list[dict[str, Any]] = [
    {"rows": 12},
    {"rows": 12, "columns": 5, "potholes": 20, "pedestrians": 3, "courtesy": 0.6},
]


def crashes(env: RoadEnv, state: dict[str, Any], action: int) -> bool:
    env.set_state(state)
    return env.step(action)[4]["outcome"] == "crash"


@pytest.mark.parametrize("parts", ROADS)
def test_a_mask_is_what_comes_of_every_move(parts: dict[str, Any]) -> None:
    env, probe, draw = RoadEnv(parts), RoadEnv(parts), np.random.default_rng(0)
    seen: set[tuple[bool, bool]] = set()
    for seed in range(12):
        observation, info = env.reset(seed=seed)
        ended = False
        while not ended:
            state, mask = env.get_state(), info["action_mask"]
            road, cell = env.config.geometry, int(np.flatnonzero(observation[VEHICLE])[0])
            ends = [crashes(probe, state, action) for action in range(6)]
            on_road = [road.moved(cell, move) is not None for move in Move]
            free = [on and not crash for on, crash in zip(on_road, ends, strict=True)]
            expected = free if any(free) else [False] * 5 + [True]
            assert mask.tolist() == expected
            assert env.action_masks().tolist() == expected
            seen |= set(zip(on_road, ends, strict=True))
            observation, _, terminated, truncated, info = env.step(int(draw.choice(np.flatnonzero(on_road))))
            ended = terminated or truncated
        assert info["action_mask"].tolist() == [0, 0, 0, 0, 0, 1]
    assert {(True, False), (True, True), (False, False)} <= seen


def test_masks_are_what_samplers_take() -> None:
    env, many = RoadEnv(), RoadVectorEnv(3)
    _, info = env.reset(seed=0)
    assert (info["action_mask"].dtype, info["action_mask"].shape) == (np.int8, (6,))
    assert info["action_mask"][env.action_space.sample(mask=info["action_mask"])]
    _, told = many.reset(seed=0)
    assert (told["action_mask"].dtype, told["action_mask"].shape) == (np.int8, (3, 6))
    assert many.action_masks().dtype == np.bool_
    assert (many.action_masks() == told["action_mask"]).all()
    with pytest.raises(RuntimeError, match="reset first"):
        RoadEnv().action_masks()
    with pytest.raises(RuntimeError, match="reset first"):
        RoadVectorEnv(2).action_masks()


def test_asking_for_masks_changes_nothing() -> None:
    asked, left = RoadVectorEnv(5, ROADS[1]), RoadVectorEnv(5, ROADS[1], action_mask=False)
    asked.reset(seed=4)
    left.reset(seed=4)
    draw = np.random.default_rng(0)
    for _ in range(60):
        actions = draw.integers(0, 6, 5)
        assert (asked.step(actions)[0] == left.step(actions)[0]).all()
