"""Frames of one world and of many, and closing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from gymnasium.vector import SyncVectorEnv

from sim.env import RoadEnv, RoadVectorEnv
from tests.support.alike import assert_alike

pytestmark = pytest.mark.xdist_group("compiled")

PARTS = {"rows": 10, "potholes": 6}


@pytest.mark.parametrize("mode", ["ansi", "rgb_array"])
def test_many_are_drawn_as_single_ones_are(mode: str) -> None:
    """In the first episode to the pixel; later things are numbered anew, and painted by their number."""
    one_by_one = SyncVectorEnv([lambda: RoadEnv(PARTS, mode)] * 3)
    many = RoadVectorEnv(3, PARTS, mode)
    assert mode in many.metadata["render_modes"]
    assert many.render_mode == mode
    one_by_one.reset(seed=2)
    many.reset(seed=2)
    for _ in range(3):
        frames = many.render()
        assert isinstance(frames, tuple)
        assert_alike(frames, one_by_one.render())
        actions = np.array([0, 5, 1])
        one_by_one.step(actions)
        many.step(actions)
    for _ in range(40):
        many.step(np.zeros(3, np.int64))
    later: Any = many.render()
    assert len(later) == 3
    if mode == "rgb_array":
        assert all(frame.dtype == np.uint8 and frame.ndim == 3 and frame.shape[2] == 3 for frame in later)


def test_without_a_render_mode_there_is_no_frame() -> None:
    for env in (RoadEnv(PARTS), RoadVectorEnv(2, PARTS)):
        with pytest.raises(RuntimeError, match="reset first"):
            env.render()  # type: ignore[attr-defined]
        env.reset(seed=0)  # type: ignore[attr-defined]
        assert env.render() is None  # type: ignore[attr-defined]


def test_closing_twice_is_closing_once() -> None:
    for env in (RoadEnv(PARTS), RoadVectorEnv(2, PARTS)):
        env.close()  # type: ignore[attr-defined]
        env.reset(seed=0)  # type: ignore[attr-defined]
        env.close()  # type: ignore[attr-defined]
        env.close()  # type: ignore[attr-defined]
    many = RoadVectorEnv(2, PARTS)
    many.reset(seed=0)
    many.close()
    assert many.closed
    with pytest.raises(RuntimeError, match="reset first"):
        many.step(np.zeros(2, np.int64))
