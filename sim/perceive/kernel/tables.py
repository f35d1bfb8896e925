"""The tables of a suite of sensors as arrays, for the compiled look (`sim.perceive.kernel.tick`).

They hold what `sim.perceive.sensor_model` and `sim.perceive.bayes_filter` compute for one weather, one time
of day and one size of road. The last axis of most of them is as wide as two roads, so that a column of the
road, less that of the vehicle, plus `columns` − 1 is a place in it. Rows are counted ahead of the vehicle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.perceive.bayes_filter import UNLIKELY, layer_misses, mixing_table
from sim.perceive.belief import FIXED, LAYER, LAYERS, RIGHT, packed, prior
from sim.perceive.log_odds import LIMIT, PROBABILITY
from sim.perceive.look import NUMBER
from sim.perceive.occlusion import half_size
from sim.perceive.parameters import SensorSpec
from sim.perceive.percept import DOUBTS
from sim.perceive.sensor_model import AS_BUILT, SensorModel, Tuning, sensor_model, tuning_of
from sim.randomness import Stream
from sim.rules.mover_boards import PERIODS
from sim.types import HAZARDS, KINDS, MARKED, MOVERS, Kind
from sim.world.grid import Road

KINDS_SEEN: Final = len(NUMBER)
AV_NUMBER: Final = KINDS_SEEN
"""The number of an autonomous vehicle among bodies that hide what is behind them."""
SHIFTS: Final = 9
"""Cells a report of one thing may come from, at most."""

LAYER_OF: Final = np.array([LAYER[kind] if kind in LAYER else RIGHT[kind] for kind in NUMBER], np.int64)
"""By number of a kind: its layer, or that of movers of it heading right."""
HOLDS: Final = np.array([KINDS[kind].holds_movers for kind in NUMBER], np.uint8)
"""By number of a kind: whether a mover may be in the same cell."""
BOARD_OF: Final = np.array(
    [
        HAZARDS.index(k) if k in HAZARDS else len(HAZARDS) + MARKED.index(k) if k in MARKED else -1
        for k in NUMBER
    ],
    np.int64,
)
"""By number of a kind: the place of its board in `Boards.by_kind`, −1 where it has none."""
PERIOD_OF: Final = np.array([PERIODS[kind] for kind in MOVERS], np.int64)
LEVELS: Final = np.array(DOUBTS)
CHANCES: Final = np.array(PROBABILITY)
_FIRST_MOVER: Final = NUMBER[MOVERS[0]]


class SuiteTables(NamedTuple):
    """The arrays of a suite; the first axis of most of them is the device."""

    devices: NDArray[np.int64]
    """(device, 3): number, rows ahead that it sees, share of headings read wrong (in 256)"""
    wrong: NDArray[np.float64]
    """(device): share of headings read wrong"""
    alarms: NDArray[np.float64]
    """(device, kind): probability of a false alarm in a cell"""
    alarm_odds: NDArray[np.float64]
    """(device, kind): odds of a false alarm in a cell, of one heading where things of the kind move"""
    alarm_order: NDArray[np.int64]
    """(device, turn): the kinds in the order in which false alarms are drawn, −1 where there is none"""
    seen: NDArray[np.uint8]
    """(device, rows, place): whether anything can be detected there"""
    drawn: NDArray[np.int64]
    """(device, kind, rows, place): probability of detection, in 2³²"""
    detection: NDArray[np.float64]
    """the same as a fraction"""
    miss: NDArray[np.int16]
    """(device, column, layer, cells): what a look without a report adds to the log odds, by the column of the
    vehicle; the cells are those of the rows it may see, the last of which is its own"""
    odds: NDArray[np.float64]
    """(device, kind, rows, place): of detection, against a miss; 0 where nothing can be detected"""
    shifts: NDArray[np.int8]
    """(device, rows, place, shift, 2): rows ahead and columns aside"""
    shares: NDArray[np.float64]
    """(device, rows, place, shift): its probability; 0 behind the last"""
    halves: NDArray[np.int64]
    """(kind, 2): half the extent of a body across and along, 0 where it hides nothing"""
    shadows: NDArray[np.int8]
    """(kind, place, rows, rows, 2): the first and last column, less the vehicle's, that a body hides in a
    row; the first axes are where the body is. Filled by the kernel, since it takes long otherwise"""


@dataclass(frozen=True, eq=False)
class Setup:
    """All that a look needs that does not change from tick to tick."""

    tables: SuiteTables
    prior: bytes
    """the belief before any look"""
    mixing: NDArray[np.int16]
    """(layer of movers, log odds + `LIMIT`): the log odds after mixing with the prior"""
    least: NDArray[np.int16]
    """(layer of movers, 2): how likely a mover is at most where there is a fixed hazard: between, and in the
    first and last row"""
    key: int
    """of the random stream of sensors, as a signed word"""


@lru_cache(maxsize=64)
def setup(config: Config, road: Road, suite: tuple[SensorSpec, ...]) -> Setup:
    """The setup of a suite under a configuration."""
    before = prior(config, road)
    inside, edge = before[FIXED:, 1, 0], before[FIXED:, 0, 0]
    return Setup(
        suite_tables(
            suite, config.weather, config.time_of_day, config.cell_m, road.columns, tuning_of(config)
        ),
        packed(before),
        np.array([mixing_table(int(value)) for value in inside], np.int16),
        np.maximum(np.stack([inside, edge], axis=1) - UNLIKELY, -LIMIT).astype(np.int16),
        _signed(Stream.of(config.seed, "sensor").key),
    )


def _signed(word: int) -> int:
    return word - (1 << 64) if word >> 63 else word


@lru_cache(maxsize=32)
def suite_tables(
    suite: tuple[SensorSpec, ...],
    weather: Weather,
    light: TimeOfDay,
    cell_m: float,
    columns: int,
    tuning: Tuning = AS_BUILT,
) -> SuiteTables:
    """The arrays of a suite under these conditions. `shadows` is still empty."""
    models = [sensor_model(spec, weather, light, cell_m, columns, tuning) for spec in suite]
    rows, places, count = max(model.reach for model in models) + 1, 2 * columns - 1, len(models)
    grid = (count, KINDS_SEEN, rows, places)
    tables = SuiteTables(
        np.array([[m.spec.number, m.reach, round(256 * m.spec.wrong_heading)] for m in models], np.int64),
        np.array([model.spec.wrong_heading for model in models]),
        np.zeros((count, KINDS_SEEN)),
        np.zeros((count, KINDS_SEEN)),
        np.full((count, KINDS_SEEN), -1, np.int64),
        np.zeros((count, rows, places), np.uint8),
        np.zeros(grid, np.int64),
        np.zeros(grid),
        np.zeros((count, columns, LAYERS, rows * columns), np.int16),
        np.zeros(grid),
        np.zeros((count, rows, places, SHIFTS, 2), np.int8),
        np.zeros((count, rows, places, SHIFTS)),
        np.array([_half(kind) for kind in (*NUMBER, Kind.AV)], np.int64),
        np.zeros((KINDS_SEEN + 1, places, rows, rows, 2), np.int8),
    )
    for device, model in enumerate(models):
        _fill(tables, device, model)
    return tables


def _half(kind: Kind) -> tuple[int, int]:
    return half_size(kind) if KINDS[kind].occludes else (0, 0)


def _fill(tables: SuiteTables, device: int, model: SensorModel) -> None:
    rows = model.reach + 1
    for turn, (kind, seen) in enumerate(model.kinds.items()):
        number = NUMBER[kind]
        tables.alarm_order[device, turn] = number
        tables.alarms[device, number] = seen.false_alarm
        alarm = seen.false_alarm / (2 if kind in MOVERS else 1)
        tables.alarm_odds[device, number] = alarm / (1.0 - alarm)
        tables.drawn[device, number, :rows] = seen.drawn
        tables.detection[device, number, :rows] = seen.detection
    tables.seen[device] = tables.drawn[device].any(axis=0)
    tables.odds[device] = tables.detection[device] / (1.0 - tables.detection[device]) * tables.seen[device]
    misses, columns = layer_misses(model), model.columns
    for column in range(columns):
        near = misses[:, :, columns - 1 - column : 2 * columns - 1 - column]
        tables.miss[device, column, :, -rows * columns :] = near.reshape(LAYERS, -1)
    for ahead, row in enumerate(model.shifts):
        for place, found in enumerate(row):
            for number, (by_rows, by_columns, share) in enumerate(found):
                tables.shifts[device, ahead, place, number] = by_rows, by_columns
                tables.shares[device, ahead, place, number] = share


assert [NUMBER[kind] - _FIRST_MOVER for kind in MOVERS] == list(range(len(MOVERS)))
assert -2 * LIMIT >= -32_768
