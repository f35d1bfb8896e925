"""The vector environment: thousands of roads as one Gymnasium `VectorEnv`, without a Python loop."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final, cast

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from sim.batch import Batch
from sim.env import saved_state as saving
from sim.env.actions import action_masks, checked_actions
from sim.env.gym_seeds import DRAWN_BELOW, check_seed, fold_seed
from sim.env.observation import Observer, batch_planes
from sim.env.options import boolean, one_of, refuse_unknown, reset_options, road_config, whole_number
from sim.env.reward import Rewards
from sim.env.single import ARGUMENTS, RENDER_FPS, RENDER_MODES, frame
from sim.metrics import Metrics
from sim.state import SimState
from sim.types import MOVES, Outcome

RUNNING, SUCCESS, CRASH, STUCK = range(len(Outcome))
"""Values of `Batch.outcomes`: integers in the order of `Outcome`."""

_NAMES: Final = np.array([str(outcome) for outcome in Outcome], object)

Observations = NDArray[np.uint8]
LaneMask = NDArray[np.bool_]


class RoadVectorEnv(VectorEnv[Observations, NDArray[np.int64], NDArray[Any]]):
    """Many `RoadEnv`, with the same results as Gymnasium's own loop over them. A *lane* is one of them.

    Gymnasium's `autoreset_mode` decides what follows the end of an episode. `NEXT_STEP`: the lane's next step
    ignores the action and begins the next episode. `SAME_STEP`: the next episode begins at once; the end is
    in `info["final_obs"]` and `info["final_info"]`. `DISABLED`: `reset(options={"reset_mask": …})` begins it.
    """

    metadata = {  # noqa: RUF012 - Gymnasium's form
        "render_modes": list(RENDER_MODES),
        "render_fps": RENDER_FPS,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
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
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        threads: int = 1,
        **unknown: Any,
    ) -> None:
        """Makes an environment of `num_envs` lanes; `threads` work on a step. Otherwise as `RoadEnv`."""
        refuse_unknown("RoadVectorEnv", unknown, (*ARGUMENTS, "num_envs", "autoreset_mode", "threads"))
        self.num_envs = whole_number("num_envs", num_envs, 1)
        self.threads = whole_number("threads", threads, 1)
        self.render_mode = None if render_mode is None else one_of("render mode", render_mode, RENDER_MODES)
        if not isinstance(autoreset_mode, AutoresetMode):
            named = one_of("autoreset mode", autoreset_mode, (mode.value for mode in AutoresetMode))
            autoreset_mode = AutoresetMode(named)
        self.autoreset_mode = autoreset_mode
        self.metadata = {**self.metadata, "autoreset_mode": autoreset_mode}
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
        self.single_observation_space = self._observer.space
        self.single_action_space = spaces.Discrete(len(MOVES))
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._batch: Batch | None = None

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins episodes. With an integer seed, lane i has seed + i; a sequence gives each lane its own.

        A lane with a seed begins the first episode of that seed, a lane without one its next episode.
        `options["reset_mask"]` (bool, shape: lanes) selects lanes; the others, and their entries in `info`,
        stay unchanged. Raises `TypeError` or `ValueError` for invalid arguments, and `GenerationError` if a
        road must be drivable and no such road is found.
        """
        chosen = self._lanes_to_reset(reset_options(options, ["reset_mask"]))
        seeds = self._seeds(seed)
        if not _is_per_lane(seed):
            super().reset(seed=None if seed is None else check_seed(seed))
        batch = self._batch
        if batch is None and not chosen.all():
            raise RuntimeError("call reset first, without a reset_mask")
        if batch is None or (chosen.all() and None not in seeds):
            missing = [lane for lane, each in enumerate(seeds) if each is None]
            if missing:
                drawn = self.np_random.integers(DRAWN_BELOW, size=len(missing))
                for lane, value in zip(missing, drawn, strict=True):
                    seeds[lane] = int(value)
            batch = Batch([self.config.with_parts(seed=each) for each in seeds], after="stop")
        else:
            batch = batch.copy()  # nothing changes if no drivable road is found
            batch.renew(chosen, seeds)
        self._batch = batch
        return self._observations(batch), self._info(batch, chosen)

    def step(
        self, actions: NDArray[np.int64]
    ) -> tuple[Observations, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Runs one tick of every lane. Raises `ValueError` for invalid actions.

        Raises `RuntimeError` before the first `reset` and, with autoreset disabled, after the end of an
        episode.
        """
        batch, moves = self._require_batch(), checked_actions(actions, self.num_envs)
        live = batch.outcomes == RUNNING
        if self.autoreset_mode is AutoresetMode.DISABLED and not live.all():
            ended = ", ".join(map(str, np.flatnonzero(~live)[:8]))
            raise RuntimeError(f"episodes have ended in lanes {ended}; reset these with reset_mask")
        before = batch.vehicles // self.config.columns
        batch.step(moves, threads=self.threads)
        after, outcomes = batch.vehicles // self.config.columns, batch.outcomes
        arrived, crashed = live & (outcomes == SUCCESS), live & (outcomes == CRASH)
        stuck = live & (outcomes == STUCK)
        paid = np.where(live, self.rewards.step_reward(before, after, arrived, crashed), 0.0)
        final: dict[str, Any] = {}
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            ended = arrived | crashed | stuck
            if ended.any():
                final = self._final(batch, ended)
                batch.renew(ended)
        elif not live.all():
            batch.renew(~live)
        everywhere = np.ones(self.num_envs, np.bool_)
        info = {**final, **self._info(batch, everywhere)}
        return self._observations(batch), paid, arrived | crashed, stuck, info

    def action_masks(self) -> NDArray[np.bool_]:
        """Which moves can be taken now (shape: lanes, 6)."""
        return action_masks(self._require_batch(), threads=self.threads)

    def render(self) -> tuple[Any, ...] | None:
        """Renders a frame of every lane, as `RoadEnv.render` does; None without a render mode."""
        batch = self._require_batch()
        if self.render_mode is None:
            return None
        return tuple(frame(self._run(batch, lane), self.render_mode) for lane in range(self.num_envs))

    def get_state(self) -> dict[str, Any]:
        """Returns the complete state as a JSON value. Raises `RuntimeError` before `reset`."""
        return saving.save_vector(self._require_batch(), self)

    def set_state(self, state: Mapping[str, Any]) -> tuple[Observations, dict[str, Any]]:
        """Restores a state with the same configuration and number of lanes; returns observations and info.

        Raises `ValueError` for an invalid state, another configuration or number, and then changes nothing.
        """
        self._batch = batch = saving.load_vector(state, self, self.num_envs)
        return self._observations(batch), self._info(batch, np.ones(self.num_envs, np.bool_))

    def close_extras(self, **kwargs: Any) -> None:
        """Releases the worlds."""
        del kwargs
        self._batch = None

    def _require_batch(self) -> Batch:
        if self._batch is None:
            raise RuntimeError("call reset first")
        return self._batch

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        """Returns the seed of each lane's configuration; None for the lane's next episode."""
        if seed is None:
            return [None] * self.num_envs
        if not _is_per_lane(seed):
            first = check_seed(seed)
            return [fold_seed(first + lane) for lane in range(self.num_envs)]
        given = list(cast(Iterable[int | None], seed))
        if len(given) != self.num_envs:
            raise ValueError(f"{self.num_envs} seeds are wanted, one for each environment, not {len(given)}")
        return [None if each is None else fold_seed(check_seed(each)) for each in given]

    def _lanes_to_reset(self, options: Mapping[str, Any]) -> LaneMask:
        """Returns the lanes to reset (shape: lanes)."""
        if "reset_mask" not in options:
            return np.ones(self.num_envs, np.bool_)
        mask = options["reset_mask"]
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_:
            raise TypeError(f"reset_mask is an array of bool, not {mask!r}")
        if mask.shape != (self.num_envs,) or not mask.any():
            raise ValueError(f"reset_mask has the shape ({self.num_envs},) and a true value, not {mask!r}")
        return mask.copy()

    def _observations(self, batch: Batch) -> Observations:
        return self._observer.of_planes(batch_planes(batch.observe()), batch.vehicles)

    def _info(self, batch: Batch, lanes: LaneMask) -> dict[str, Any]:
        """Returns `info` of these lanes; the others have 0 or None, and False in the masks `_…`."""
        outcomes = batch.outcomes
        told: dict[str, Any] = {
            "outcome": _NAMES[outcomes],
            "is_success": outcomes == SUCCESS,
            "tick": batch.episode_ticks,
            "episode_number": batch.episodes,
            "seed": batch.seeds,
        }
        if self._masked:
            told["action_mask"] = action_masks(batch, threads=self.threads).astype(np.int8)
        info: dict[str, Any] = {}
        for key, values in told.items():
            if not lanes.all():
                values[~lanes] = None if values.dtype == object else 0
            info[key], info[f"_{key}"] = values, lanes.copy()
        return info

    def _final(self, batch: Batch, ended: LaneMask) -> dict[str, Any]:
        """Returns the last observations and infos of the ended lanes, in Gymnasium's form."""
        last = np.full(self.num_envs, None, object)
        seen = self._observations(batch)
        for lane in np.flatnonzero(ended):
            last[lane] = seen[lane].copy()
        told = self._info(batch, ended)
        return {
            "final_obs": last,
            "_final_obs": ended.copy(),
            "final_info": told,
            "_final_info": ended.copy(),
        }

    def _run(self, batch: Batch, lane: int) -> SimState:
        """Returns the state of one lane, as far as its picture shows it."""
        totals = batch.totals()
        counted = Metrics(
            successes=int(totals.successes[lane]),
            crashes=int(totals.crashes[lane]),
            stuck=int(totals.stuck[lane]),
        )
        return SimState(batch.configs[lane], batch.world(lane)).with_ego(metrics=counted)


def _is_per_lane(seed: object) -> bool:
    """Whether `seed` holds one seed per lane rather than one for all."""
    return isinstance(seed, Iterable) and not isinstance(seed, str | bytes)
