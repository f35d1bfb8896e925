"""The reward of a tick, the same for the single and the vector environment.

The reward of a tick is

    goal_reward · arrived − crash_penalty · crashed − step_cost + discount · Φ(after) − Φ(before)

where the potential Φ of a state is `progress_reward` times the share of the rows that have been driven, and 0
after arrival or crash. This is the potential-based shaping of Ng, Harada & Russell ("Policy invariance under
reward transformations", ICML 1999): with the learner's `discount`, every `progress_reward` has the same best
policy, because the potential is taken back when an episode terminates. A truncated episode keeps its
potential, since a learner bootstraps from its last state.

By default waiting until the time is up costs 2, twice a crash, so standing still is never the best policy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.config import Config
from sim.env.options import number


@dataclass(frozen=True, slots=True)
class Rewards:
    """The parameters of the reward, each 0 or more; penalties and costs are subtracted."""

    goal_reward: float
    crash_penalty: float
    step_cost: float
    progress_reward: float
    discount: float
    rows: int

    @staticmethod
    def of(
        config: Config,
        *,
        goal_reward: float,
        crash_penalty: float,
        step_cost: float | None,
        progress_reward: float,
        discount: float,
    ) -> Rewards:
        """Returns the rewards for a road; `step_cost` None means 2 / `max_ticks`. Raises `ValueError`."""
        return Rewards(
            number("goal_reward", goal_reward),
            number("crash_penalty", crash_penalty),
            2.0 / config.max_ticks if step_cost is None else number("step_cost", step_cost),
            number("progress_reward", progress_reward),
            number("discount", discount, 0.0, 1.0),
            config.rows,
        )

    def step_reward(
        self,
        before: NDArray[np.int64],
        after: NDArray[np.int64],
        arrived: NDArray[np.bool_],
        crashed: NDArray[np.bool_],
    ) -> NDArray[np.float64]:
        """Computes the reward of a tick. Shape of arguments and result: worlds.

        `before` and `after` are the rows of the ego (0 is the goal).
        """
        kept = np.where(arrived | crashed, 0.0, self._potential(after))
        paid: NDArray[np.float64] = (
            self.goal_reward * arrived
            - self.crash_penalty * crashed
            - self.step_cost
            + (self.discount * kept - self._potential(before))
        )
        return paid

    def _potential(self, row: NDArray[np.int64]) -> NDArray[np.float64]:
        last = self.rows - 1
        share: NDArray[np.float64] = self.progress_reward * (last - row) / last
        return share
