"""The single environment: one road as a Gymnasium `Env`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from sim.config import Config
from sim.decide import moves_where, sense
from sim.env import saved_state as saving
from sim.env.actions import STAY, action_mask, checked_action
from sim.env.gym_seeds import DRAWN_BELOW, check_seed, fold_seed
from sim.env.observation import Observer
from sim.env.options import boolean, one_of, refuse_unknown, reset_options, road_config
from sim.env.reward import Rewards
from sim.perceive.observe import observe
from sim.state import FIRST, SimState, next_episode
from sim.transition import transition
from sim.types import MOVES, Outcome
from sim.world import notation

RENDER_MODES: Final = ("ansi", "rgb_array")
RENDER_FPS: Final = 2

ARGUMENTS: Final = (
    "config",
    "render_mode",
    "observation",
    "window",
    "action_mask",
    "goal_reward",
    "crash_penalty",
    "step_cost",
    "progress_reward",
    "discount",
)
"""Keyword arguments of both environments."""


class RoadEnv(gymnasium.Env[NDArray[np.uint8], np.int64]):
    """An environment in which the agent drives the ego to row 0.

    Actions are the six moves in the order of `Move`. A move off the road becomes `stay`; every other move is
    executed. `reset(seed=…)` begins the first episode of that seed, a reset without a seed the next episode.
    Episodes terminate on arrival and crash, and are truncated when the time is up. Spaces, rewards and `info`
    are described in `sim/env/README.md`.
    """

    metadata = {"render_modes": list(RENDER_MODES), "render_fps": RENDER_FPS}  # noqa: RUF012 - Gymnasium's form

    def __init__(
        self,
        config: Mapping[str, Any] | None = None,
        render_mode: str | None = None,
        *,
        observation: str = "planes",
        window: Sequence[int] | None = None,
        action_mask: bool = True,
        goal_reward: float = 2.0,
        crash_penalty: float = 1.0,
        step_cost: float | None = None,
        progress_reward: float = 1.0,
        discount: float = 1.0,
        **unknown: Any,
    ) -> None:
        """Makes an environment. `config` holds settings of `sim.config.Config` except the seed.

        `observation` and `window` are described in `sim.env.observation`, the reward options in
        `sim.env.reward`; `action_mask` says whether `info` has one. Raises `TypeError` for an unknown
        argument, `ConfigError` for an invalid configuration and `ValueError` for any other invalid value.
        """
        refuse_unknown("RoadEnv", unknown, ARGUMENTS)
        self.render_mode = None if render_mode is None else one_of("render mode", render_mode, RENDER_MODES)
        self.config = road_config(config)
        self.rewards = Rewards.of(
            self.config,
            goal_reward=goal_reward,
            crash_penalty=crash_penalty,
            step_cost=step_cost,
            progress_reward=progress_reward,
            discount=discount,
        )
        self._observer = Observer.of(self.config, observation, window)
        self._masked = boolean("action_mask", action_mask)
        self.observation_space = self._observer.space
        self.action_space = spaces.Discrete(len(MOVES))
        self._run: SimState | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """Begins an episode. Raises `TypeError` or `ValueError` for an invalid seed or option.

        Raises `GenerationError` if the road must be drivable and no such road is found.
        """
        reset_options(options)
        given = None if seed is None else check_seed(seed)
        super().reset(seed=given, options=options)
        if self._run is not None and given is None:
            self._run = next_episode(self._run)[0]
        else:
            drawn = int(self.np_random.integers(DRAWN_BELOW)) if given is None else fold_seed(given)
            self._run = SimState.start(self.config.with_parts(seed=drawn))
        return self._observation(), self._info()

    def step(self, action: np.int64 | int) -> tuple[NDArray[np.uint8], float, bool, bool, dict[str, Any]]:
        """Runs one tick. Raises `ValueError` for an invalid action.

        Raises `RuntimeError` before `reset` and after the end of the episode.
        """
        state, number = self._begun(), checked_action(action)
        before = state.world
        if before.outcome is not Outcome.RUNNING or before.av < before.road.columns:
            raise RuntimeError("the episode has ended; call reset")
        if state.config.ego_dynamics(before.road).target(before.av, MOVES[number]) is None:
            number = STAY
        # Counts as a person's move, so that a repeated situation does not end the episode.
        moves = moves_where(state, MOVES[number])
        self._run = transition(state, moves, by_person=(FIRST,)).state
        after = self._run.world
        crashed = after.outcome is Outcome.CRASH
        arrived = after.av < after.road.columns and not crashed
        columns = before.road.columns
        paid = self.rewards.step_reward(
            np.array([before.av // columns]),
            np.array([after.av // columns]),
            np.array([arrived]),
            np.array([crashed]),
        )
        truncated = after.outcome is Outcome.STUCK
        return self._observation(), float(paid[0]), arrived or crashed, truncated, self._info()

    def action_masks(self) -> NDArray[np.bool_]:
        """Which moves can be taken now (shape: 6), in the form `sb3_contrib.MaskablePPO` expects."""
        return action_mask(self._begun().world, self.config_of_episode)

    def render(self) -> Any:
        """Renders the road as text (`ansi`) or pixels (`rgb_array`, shape: height, width, 3)."""
        return frame(self._begun(), self.render_mode)

    def get_state(self) -> dict[str, Any]:
        """Returns the complete state as a JSON value. Raises `RuntimeError` before `reset`."""
        return saving.save_single(self._begun(), self)

    def set_state(self, state: Mapping[str, Any]) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """Restores a state of an environment with the same configuration; returns its observation and info.

        Raises `ValueError` for an invalid state or another configuration, and then changes nothing.
        """
        self._run = saving.load_single(state, self)
        return self._observation(), self._info()

    @property
    def config_of_episode(self) -> Config:
        """The configuration with the current seed. Raises `RuntimeError` before `reset`."""
        return self._begun().config

    def _begun(self) -> SimState:
        if self._run is None:
            raise RuntimeError("call reset first")
        return self._run

    def _observation(self) -> NDArray[np.uint8]:
        state = self._begun()
        planes = observe(sense(state)[0])
        shown: NDArray[np.uint8] = self._observer.of_planes(planes[None], np.array([state.world.av]))[0]
        return shown

    def _info(self) -> dict[str, Any]:
        state = self._begun()
        world = state.world
        told: dict[str, Any] = {
            "outcome": str(world.outcome),
            "is_success": world.av < world.road.columns and world.outcome is not Outcome.CRASH,
            "tick": world.episode_tick,
            "episode_number": world.episode,
            "seed": state.config.seed,
        }
        if self._masked:
            told["action_mask"] = action_mask(world, state.config).astype(np.int8)
        return told


def frame(state: SimState, render_mode: str | None) -> Any:
    """Renders a state in a render mode; returns None without one."""
    if render_mode == "ansi":
        return notation.write(state.world)
    if render_mode == "rgb_array":
        from sim.render import pixels, render

        return pixels(render("road", state))
    return None
