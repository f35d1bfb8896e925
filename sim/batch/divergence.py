"""Where two planners part: the same roads, driven by each, compared tick by tick."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sim.batch.batch import Batch, BatchPlanner
from sim.config import Config


def first_divergence(
    configs: Sequence[Config], one: BatchPlanner, other: BatchPlanner, *, threads: int = 1
) -> NDArray[np.int64]:
    """The tick of the first decision in which two planners differ in the first episode (shape: lanes).

    −1 where they drive the same way until the first of them has ended.
    """
    first, second = Batch(configs, after="stop"), Batch(configs, after="stop")
    parted = np.full(len(first), -1, np.int64)
    tick = 0
    while (together := (parted < 0) & (first.outcomes == 0) & (second.outcomes == 0)).any():
        first.run(1, one, threads=threads)
        second.run(1, other, threads=threads)
        parted[together & (first.vehicles != second.vehicles)] = tick
        tick += 1
    return parted
