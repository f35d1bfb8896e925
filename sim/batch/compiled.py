"""The rules' own text compiled for machine words (`sim.compilation`)."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from sim.compilation import compiled, numbers, with_names
from sim.rules import ego_step, limits, traffic
from sim.rules.mover_boards import PERIODS
from sim.types import Kind

steps_in_tick = with_names(traffic.steps_in_tick)
move_movers = with_names(traffic.move_movers)
brake = with_names(traffic.brake)
followed_board = with_names(traffic.shift_board)
cut_off = with_names(ego_step.cut_off)
free_steps = with_names(ego_step.free_steps)
spread = with_names(ego_step.spread)
spread_back = with_names(ego_step.spread_back)
beside = with_names(ego_step.beside)
max_ticks = with_names(limits.max_ticks)
steps_left = with_names(limits.steps_left, max_ticks=max_ticks)


_trailing_zeros: Any = numbers.trailing_zeros


_PEDESTRIAN_PERIOD: Final = PERIODS[Kind.PEDESTRIAN]


@compiled
def pedestrians_walk(episode_tick):
    """Whether pedestrians step in the tick that begins at `episode_tick`."""
    return steps_in_tick(_PEDESTRIAN_PERIOD, episode_tick)


@compiled
def first_bit(word):
    """The number of the lowest bit of a word that has one."""
    return np.int64(_trailing_zeros(word))
