"""One world as a Gymnasium environment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from sim.config import Config
from sim.decide import sense
from sim.env import saved_state as saving
from sim.env.actions import STAY, action_mask, checked_action
from sim.env.observation import Observer
from sim.env.options import one_of, refuse_unknown, reset_options, road_config, switch
from sim.env.reward import Rewards
from sim.env.seeds import DRAWN_BELOW, checked_seed, folded
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
"""What both environments take."""


class RoadEnv(gymnasium.Env[NDArray[np.uint8], np.int64]):
    """Drive the vehicle to row 0. Actions are the six moves in the order of `Move`.

    A move off the road is a wait; nothing else is held back. `reset(seed=…)` begins that seed's first
    episode, a reset without a seed the one that follows. Episodes terminate on arrival and crash, and are
    truncated when the time is up. The parts are described in `sim/env/README.md`.
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
        """A road of `config`, any part of `sim.config.Config` but the seed.

        `observation`, `window`: `sim.env.observation`; `action_mask`: whether `info` has one; the others:
        `sim.env.reward`. Raises `TypeError` for an unknown argument, `ConfigError` for a configuration and
        `ValueError` for any other value that cannot be.
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
        self._masked = switch("action_mask", action_mask)
        self.observation_space = self._observer.space
        self.action_space = spaces.Discrete(len(MOVES))
        self._run: SimState | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """The beginning of an episode. Raises `TypeError` or `ValueError` for a seed or option that is none.

        Raises `GenerationError` where the road must be drivable and none is found.
        """
        reset_options(options)
        given = None if seed is None else checked_seed(seed)
        super().reset(seed=given, options=options)
        if self._run is not None and given is None:
            self._run = next_episode(self._run)[0]
        else:
            drawn = int(self.np_random.integers(DRAWN_BELOW)) if given is None else folded(given)
            self._run = SimState.start(self.config.with_parts(seed=drawn))
        return self._observation(), self._info()

    def step(self, action: np.int64 | int) -> tuple[NDArray[np.uint8], float, bool, bool, dict[str, Any]]:
        """One tick. Raises `ValueError` for an action that is none.

        Raises `RuntimeError` before `reset`, and once the episode has ended.
        """
        state, number = self._begun(), checked_action(action)
        before = state.world
        if before.outcome is not Outcome.RUNNING:
            raise RuntimeError("the episode has ended; call reset")
        if state.config.ego_dynamics(before.road).target(before.av, MOVES[number]) is None:
            number = STAY
        # As a person's move: what repeats then proves nothing about a planner.
        self._run = transition(state, {FIRST: MOVES[number]}, by_person=(FIRST,)).state
        after = self._run.world
        arrived, crashed = after.outcome is Outcome.SUCCESS, after.outcome is Outcome.CRASH
        columns = before.road.columns
        paid = self.rewards.paid(
            np.array([before.av // columns]),
            np.array([after.av // columns]),
            np.array([arrived]),
            np.array([crashed]),
        )
        truncated = after.outcome is Outcome.STUCK
        return self._observation(), float(paid[0]), arrived or crashed, truncated, self._info()

    def action_masks(self) -> NDArray[np.bool_]:
        """Which moves can be taken now (shape: 6), as `sb3_contrib.MaskablePPO` asks for it."""
        return action_mask(self._begun().world, self.config_of_episode)

    def render(self) -> Any:
        """The road as text (`ansi`) or as pixels (`rgb_array`, shape: height, width, 3)."""
        return frame(self._begun(), self.render_mode)

    def get_state(self) -> dict[str, Any]:
        """All that the continuation hangs on, as a JSON value. Raises `RuntimeError` before `reset`."""
        return saving.of_run(self._begun(), self)

    def set_state(self, state: Mapping[str, Any]) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """Go on from a state of an environment of the same configuration: its observation and info.

        Raises `ValueError` for a state of another configuration, and for what is no such state; nothing is
        changed then.
        """
        self._run = saving.to_run(state, self)
        return self._observation(), self._info()

    @property
    def config_of_episode(self) -> Config:
        """The configuration with the seed of the present episode. Raises `RuntimeError` before `reset`."""
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
            "is_success": world.outcome is Outcome.SUCCESS,
            "tick": world.episode_tick,
            "episode_number": world.episode,
            "seed": state.config.seed,
        }
        if self._masked:
            told["action_mask"] = action_mask(world, state.config).astype(np.int8)
        return told


def frame(state: SimState, render_mode: str | None) -> Any:
    """One world's frame in a render mode; None without one."""
    if render_mode == "ansi":
        return notation.write(state.world)
    if render_mode == "rgb_array":
        from sim.render import pixels, render

        return pixels(render("road", state))
    return None
