"""Episodes of many seeds by the rule planner, one after another in the lanes of a single block.

Where an episode has ended its lane begins that of the next seed in the same tick: no lane waits for the
longest episode beside it, and all that is read and written stays in the processor's nearest cache. The
episodes are those of a batch made with `after="stop"`, bit for bit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.batch.batch import Batch
from sim.batch.lanes import SeededConfigs
from sim.batch.layout import LANES, QUEUE_MOVES, QUEUE_OUTCOME, QUEUE_SEED, WATCHING
from sim.batch.tick_kernel import MOVE_FIELD, ticks_kernel
from sim.config import Config
from sim.generation import GenerationError
from sim.rules.limits import max_ticks
from sim.sensor_names import DEFAULT_SENSOR

_FIELD: Final = np.uint64(2**MOVE_FIELD - 1)
_NONE_FOUND: Final = np.uint64(2**64 - 1)
"""Stands for the outcome of an episode for which no road was found."""


@dataclass(frozen=True, slots=True)
class Ends:
    """How episodes ended (shape of each: episodes)."""

    outcomes: NDArray[np.uint8]
    """indices in the order of `Outcome`"""
    forward: NDArray[np.uint16]
    lateral: NDArray[np.uint16]
    diagonal: NDArray[np.uint16]
    stay: NDArray[np.uint16]


def drive_to_end(config: Config, seeds: NDArray[np.int64]) -> Ends:
    """The first episode of a configuration with each of these seeds (shape: episodes), driven to its end.

    Raises as `Batch.of_seeds` does, and `ValueError` for a sensor that errs.
    """
    if config.sensor != DEFAULT_SENSOR:
        raise ValueError(f"a relay sees with the sensor {DEFAULT_SENSOR!r}, not with {config.sensor!r}")
    queue = np.zeros((len(seeds), 3), np.uint64)
    queue[:, QUEUE_SEED] = seeds
    if len(seeds):
        _Relay(SeededConfigs(config, seeds[:LANES]), after="stop").drive(queue)
    moves = queue[:, QUEUE_MOVES]
    return Ends(
        queue[:, QUEUE_OUTCOME].astype(np.uint8),
        *((moves >> np.uint64(MOVE_FIELD * place) & _FIELD).astype(np.uint16) for place in range(4)),
    )


class _Relay(Batch):
    """One block of lanes, in which the first episodes of a queue have begun."""

    def drive(self, queue: NDArray[np.uint64]) -> None:
        """Drive all episodes of the queue, and write there how they ended. Raises `GenerationError`."""
        kernel = ticks_kernel(
            walking=self._walking(),
            courteous=self._by_chance,
            bodily=self._bodily,
            watching=bool(self._plane(WATCHING).any()),
            held=False,
            asked=False,
            renewed=False,
            relayed=True,
        )
        most = max_ticks(self.layout.rows) + 1
        kernel(
            self._state,
            self._state,
            self._lanes,
            self._lanes,
            self._wholes,
            self._shares,
            *self._geometry(),
            most * len(queue),
            queue,
        )
        if (queue[:, QUEUE_OUTCOME] == _NONE_FOUND).any():
            raise GenerationError
