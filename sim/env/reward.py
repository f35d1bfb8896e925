"""What a tick is worth, the same for one world and for many.

A tick is worth

    goal_reward · arrived − crash_penalty · crashed − step_cost + discount · Φ(after) − Φ(before)

where the potential Φ of a state is `progress_reward` times the share of the rows that have been driven, and 0
once the vehicle has arrived or crashed. This is the potential-based shaping of Ng, Harada & Russell ("Policy
invariance under reward transformations", ICML 1999): which policy is best for a learner of this discount is
the same with any `progress_reward`, since what was paid for rows is taken back when the episode terminates. A
truncated episode keeps it: its last state is one that a learner bootstraps from.

By default waiting until the time is up costs 2, twice a crash, so that standing still is never the best.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.config import Config
from sim.env.options import number


@dataclass(frozen=True, slots=True)
class Rewards:
    """The parts of the reward; all are 0 or more, a penalty or a cost is subtracted."""

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
        """The rewards on a road; `step_cost` None: two over the longest episode. Raises `ValueError`."""
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
        """What a tick is worth (shape of all: worlds); `before` and `after` are rows, 0 is the goal."""
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
