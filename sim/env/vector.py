"""Thousands of worlds as one Gymnasium vector environment, without a Python loop over them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from sim.batch import Batch
from sim.config import Config
from sim.env.observation import PLANES, rewards
from sim.env.single import MOVES, SEEDS
from sim.kinds import Outcome

RUNNING, SUCCESS, CRASH, STUCK = range(len(Outcome))
"""As `Batch.outcomes` has them: numbers in the order of `Outcome`."""

Observations = NDArray[np.uint8]


class RoadVectorEnv(VectorEnv[Observations, NDArray[np.int64], NDArray[Any]]):
    """As `RoadEnv`, many times. The step after an end ignores the action and begins the next episode."""

    metadata = {  # noqa: RUF012 - Gymnasium's form
        "render_modes": [],
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self, num_envs: int = 1, config: Mapping[str, Any] | None = None, *, threads: int = 1, **_: Any
    ) -> None:
        """`config`: any part of `sim.config.Config` but the seed. Raises `ConfigError`."""
        self.config = Config().with_parts(**{**(config or {}), "reset_delay_s": 0.0})
        self.num_envs = num_envs
        self.threads = threads
        shape = (PLANES, self.config.rows, self.config.columns)
        self.single_observation_space = spaces.Box(0, 1, shape, np.uint8)
        self.single_action_space = spaces.Discrete(len(MOVES))
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._batch: Batch | None = None

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """All lanes at the beginning of their first episode; lane i of an integer seed has seed + i."""
        super().reset(seed=seed if isinstance(seed, int) else None, options=options)
        given = [None] * self.num_envs if seed is None else seed
        if isinstance(given, int):
            given = [given + lane for lane in range(self.num_envs)]
        drawn = self.np_random.integers(SEEDS, size=self.num_envs)
        seeds = [int(drawn[lane]) if each is None else each for lane, each in enumerate(given)]
        self._batch = Batch([self.config.with_parts(seed=each) for each in seeds])
        return self._batch.observe(), self._info(self._batch)

    def step(
        self, actions: NDArray[np.int64]
    ) -> tuple[Observations, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """One tick of every lane. Raises `RuntimeError` before the first `reset`."""
        if self._batch is None:
            raise RuntimeError("call reset first")
        batch = self._batch
        before, live = batch.vehicles // self.config.columns, batch.outcomes == RUNNING
        batch.step(np.asarray(actions, np.uint8), threads=self.threads)
        gained = before - batch.vehicles // self.config.columns
        outcomes = batch.outcomes
        arrived, crashed = live & (outcomes == SUCCESS), live & (outcomes == CRASH)
        paid = rewards(gained, arrived, crashed, self.config) * live
        return batch.observe(), paid, arrived | crashed, live & (outcomes == STUCK), self._info(batch)

    def close_extras(self, **kwargs: Any) -> None:
        """Let the worlds go."""
        del kwargs
        self._batch = None

    def _info(self, batch: Batch) -> dict[str, Any]:
        return {"outcome": batch.outcomes, "tick": batch.episode_ticks, "episode": batch.episodes}
