"""Actions: which there are, checked, and which of them can be taken now.

A move is masked out when it leads off the road or would certainly end in a collision in the coming tick.
Where every move would, and once the episode has ended, to stay is left, so that every mask has an action.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from sim.batch import Batch
from sim.config import Config
from sim.forecast import Forecast
from sim.types import MOVES, Move, Outcome
from sim.world import World
from sim.world.grid import Road

STAY: Final = MOVES.index(Move.STAY)
_NAMES: Final = ", ".join(f"{number} {move}" for number, move in enumerate(MOVES))
_WANTED: Final = f"a whole number from 0 to {len(MOVES) - 1} ({_NAMES})"
_CRASH: Final = tuple(Outcome).index(Outcome.CRASH)

Masks = NDArray[np.bool_]


def checked_action(action: object) -> int:
    """The number of a move. Raises `ValueError` for anything that is not in the action space."""
    value = np.asarray(action)
    if value.shape != () or value.dtype.kind not in "iu" or not 0 <= value < len(MOVES):
        raise ValueError(f"an action is {_WANTED}, not {action!r}")
    return int(value)


def checked_actions(actions: Any, count: int) -> NDArray[np.uint8]:
    """The numbers of moves (shape: lanes). Raises `ValueError` that names the first lane that is wrong."""
    values = np.asarray(actions)
    if values.shape != (count,):
        raise ValueError(f"actions have the shape ({count},), one for each lane, not {values.shape}")
    if values.dtype.kind not in "iu":
        raise ValueError(f"an action is {_WANTED}, not {values[0]!r} (of type {values.dtype})")
    wrong = (values < 0) | (values >= len(MOVES))
    if wrong.any():
        lane = int(wrong.argmax())
        raise ValueError(f"an action is {_WANTED}, not {values[lane]} (lane {lane})")
    return values.astype(np.uint8)


def action_mask(world: World, config: Config) -> Masks:
    """The moves of one world (shape: 6)."""
    free = [False] * len(MOVES)
    if world.outcome is Outcome.RUNNING:
        free = [bool(end) for end in Forecast.of_truth(world, config, 1).own_steps()]
    if not any(free):
        free[STAY] = True
    return np.array(free, np.bool_)


def action_masks(batch: Batch, *, threads: int = 1) -> Masks:
    """The moves of every lane (shape: lanes, 6)."""
    mask = _on_road(batch.layout.road)[batch.vehicles]
    mask &= batch.trials(threads=threads) != _CRASH
    mask[batch.outcomes != 0] = False
    return _never_empty(mask)


def _never_empty(mask: Masks) -> Masks:
    mask[..., STAY] |= ~mask.any(axis=-1)
    return mask


@lru_cache(maxsize=8)
def _on_road(road: Road) -> Masks:
    """Whether a move leads to a cell of the road (shape: cells, 6)."""
    cells = range(road.columns * road.rows)
    return np.array([[road.moved(cell, move) is not None for move in MOVES] for cell in cells])
