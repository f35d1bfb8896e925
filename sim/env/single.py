"""One world as a Gymnasium environment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from sim import notation
from sim.config import Config
from sim.env.observation import PLANES, observed, rewards
from sim.kinds import Move, Outcome
from sim.run import Run, next_episode
from sim.transition import transition

MOVES: Final = tuple(Move)
SEEDS: Final = 2**32


class RoadEnv(gymnasium.Env[NDArray[np.uint8], np.int64]):
    """Drive the vehicle to row 0. Actions are the six moves in the order of `Move`.

    A move off the road is a wait; nothing else is held back. `reset(seed=…)` begins that seed's first
    episode, a reset without a seed the one that follows. Episodes terminate on arrival and crash, and are
    truncated when the time is up.
    """

    metadata = {"render_modes": ["ansi", "rgb_array"], "render_fps": 2}  # noqa: RUF012 - Gymnasium's form

    def __init__(self, config: Mapping[str, Any] | None = None, render_mode: str | None = None) -> None:
        """`config`: any part of `sim.config.Config` but the seed. Raises `ConfigError`."""
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise ValueError(f"there is no render mode {render_mode!r}")
        self.config = Config().with_parts(**(config or {}))
        self.render_mode = render_mode
        shape = (PLANES, self.config.rows, self.config.columns)
        self.observation_space = spaces.Box(0, 1, shape, np.uint8)
        self.action_space = spaces.Discrete(len(MOVES))
        self._run: Run | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """The beginning of an episode."""
        super().reset(seed=seed, options=options)
        if self._run is not None and seed is None:
            self._run = next_episode(self._run)[0]
        else:
            drawn = int(self.np_random.integers(SEEDS)) if seed is None else seed
            self._run = Run.start(self.config.with_parts(seed=drawn))
        return observed(self._run.world), self._info()

    def step(self, action: np.int64 | int) -> tuple[NDArray[np.uint8], float, bool, bool, dict[str, Any]]:
        """One tick. Raises `RuntimeError` before `reset`, and once the episode has ended."""
        run = self._begun()
        before = run.world
        if before.outcome is not Outcome.RUNNING:
            raise RuntimeError("the episode has ended; call reset")
        move = MOVES[int(action)]
        if before.road.moved(before.av, move) is None:
            move = Move.STAY
        after = transition(before, move, run.config)
        result = after.outcome
        self._run = replace(run, world=after)
        gained = before.av // before.road.columns - after.av // after.road.columns
        reward = rewards(
            np.array([gained]),
            np.array([result is Outcome.SUCCESS]),
            np.array([result is Outcome.CRASH]),
            run.config,
        )
        terminated = result in (Outcome.SUCCESS, Outcome.CRASH)
        return observed(after), float(reward[0]), terminated, result is Outcome.STUCK, self._info()

    def render(self) -> Any:
        """The road as text (`ansi`) or as pixels (`rgb_array`, shape: height, width, 3)."""
        run = self._begun()
        if self.render_mode == "ansi":
            return notation.write(run.world)
        if self.render_mode == "rgb_array":
            from sim.view import pixels, render

            return pixels(render("road", run))
        return None

    def _begun(self) -> Run:
        if self._run is None:
            raise RuntimeError("call reset first")
        return self._run

    def _info(self) -> dict[str, Any]:
        world = self._begun().world
        return {"outcome": str(world.outcome), "tick": world.episode_tick, "episode": world.episode}
