"""What a device can see from where it is: tables by kind, row and column, for one weather and time of day.

The tables are as wide as two roads, so that the columns of a road are a slice of them wherever the vehicle
is. Probabilities that draws are compared with are whole numbers below 2³².
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import atan2, ceil, degrees, erf, hypot, inf, log, radians, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.perceive.detection import detection_probability
from sim.perceive.log_odds import UNITS
from sim.perceive.parameters import MAX_REACH, SensorSpec
from sim.types import Kind
from sim.world.grid import Board

Grid = NDArray[np.int32]
Shift = tuple[int, int, float]
"""(rows further ahead, columns to the right, probability) of a displaced report."""

FULL: Final = 1 << 32
_LEAST_SHIFT: Final = 0.01
"""Displacements that are rarer are left out."""


@dataclass(frozen=True, eq=False)
class KindModel:
    """How things of one kind are seen, by rows ahead and by columns to the right plus `columns` − 1."""

    detection: list[list[float]]
    """probability of detection in one look"""
    drawn: list[list[int]]
    """the same out of 2³²"""
    miss: Grid
    """what a look without a report adds to the log odds"""
    false_alarm: float
    """probability of a false alarm in a cell in one look"""


@dataclass(frozen=True, eq=False)
class SensorModel:
    """One device under one weather and at one time of day, on roads with so many columns."""

    spec: SensorSpec
    columns: int
    reach: int
    """rows ahead that it sees, at most"""
    kinds: dict[Kind, KindModel]
    shifts: list[list[tuple[Shift, ...]]]
    """where reports of a thing come from, by rows ahead and columns as above; the first is its own cell"""

    def view(self, column: int) -> Board:
        """The field of view from a column, on a board whose last row is the vehicle's own."""
        return _view(self, column)


@lru_cache(maxsize=512)
def _view(model: SensorModel, column: int) -> Board:
    board, columns = 0, model.columns
    for rows in range(model.reach + 1):
        for other in range(columns):
            place = other - column + columns - 1
            if any(kind.drawn[rows][place] for kind in model.kinds.values()):
                board |= 1 << (model.reach - rows) * columns + other
    return board


class Tuning(NamedTuple):
    """What people set of every device."""

    range_m: float
    """no device sees farther"""
    noise: float
    """added to the standard deviation of a measured distance, as a share of the distance"""
    false_alarms: float
    """added to the probability of a false alarm in one look, shared out evenly among the kinds"""


AS_BUILT: Final = Tuning(inf, 0.0, 0.0)
"""Devices as they are."""


def tuning_of(config: Config) -> Tuning:
    """The tuning under a configuration."""
    return Tuning(config.sensor_range_m, config.sensor_noise, config.false_positive_rate)


@lru_cache(maxsize=64)
def sensor_model(
    spec: SensorSpec,
    weather: Weather,
    light: TimeOfDay,
    cell_m: float,
    columns: int,
    tuning: Tuning = AS_BUILT,
) -> SensorModel:
    """The tables of a device."""
    factor = min(spec.weather[weather].reach, spec.light[light].reach)
    range_m = min(spec.range_m * factor, tuning.range_m)
    reach = max(1, min(MAX_REACH, ceil(range_m / cell_m)))
    places = [[(rows, across) for across in range(1 - columns, columns)] for rows in range(reach + 1)]
    kinds = {
        kind: _kind_model(spec, kind, weather, light, cell_m, places, range_m, tuning)
        for kind in spec.targets
    }
    shifts = [[_shifts(spec, rows, across, cell_m, tuning) for rows, across in row] for row in places]
    return SensorModel(spec, columns, reach, kinds, shifts)


def _kind_model(
    spec: SensorSpec,
    kind: Kind,
    weather: Weather,
    light: TimeOfDay,
    cell_m: float,
    places: list[list[tuple[int, int]]],
    range_m: float,
    tuning: Tuning,
) -> KindModel:
    alarms = spec.targets[kind].false_alarms * spec.weather[weather].false_alarms
    alarm = alarms * spec.light[light].false_alarms / 100.0
    if tuning.false_alarms:
        cells = len(places) * (len(places[0]) + 1) // 2  # of a road: `places` are as wide as two
        alarm += tuning.false_alarms / len(spec.targets) / cells
    detection = [
        [
            detection_probability(spec, kind, weather, light, cell_m * hypot(rows, across))
            if _in_view(spec, rows, across) and cell_m * hypot(rows, across) <= range_m
            else 0.0
            for rows, across in row
        ]
        for row in places
    ]
    miss = np.array(
        [[round(UNITS * log((1.0 - p) / (1.0 - alarm))) if p else 0 for p in row] for row in detection],
        np.int32,
    )
    drawn = [[round(p * FULL) for p in row] for row in detection]
    return KindModel(detection, drawn, miss, alarm)


def _in_view(spec: SensorSpec, rows: int, across: int) -> bool:
    if rows == across == 0:
        return False
    return degrees(abs(atan2(across, rows))) <= spec.view_deg / 2


def _shifts(spec: SensorSpec, rows: int, across: int, cell_m: float, tuning: Tuning) -> tuple[Shift, ...]:
    """Where a thing there may be reported: normal errors along and across the ray, rounded to cells."""
    distance = cell_m * hypot(rows, across)
    if distance == 0.0:
        return ((0, 0, 1.0),)
    along, across_m = hypot(spec.along, tuning.noise) * distance, sin(radians(spec.across_deg)) * distance
    ahead, aside = cell_m * rows / distance, cell_m * across / distance
    in_rows = _rounded(hypot(along * ahead, across_m * aside) / cell_m)
    in_columns = _rounded(hypot(along * aside, across_m * ahead) / cell_m)
    found = [
        (by_rows, by_columns, a * b)
        for by_rows, a in zip((0, 1, -1), in_rows, strict=True)
        for by_columns, b in zip((0, 1, -1), in_columns, strict=True)
    ]
    kept = [shift for shift in found if shift[2] >= _LEAST_SHIFT]
    whole = sum(share for _, _, share in kept)
    return tuple((by_rows, by_columns, share / whole) for by_rows, by_columns, share in kept)


def _rounded(sigma: float) -> tuple[float, float, float]:
    """Probabilities that a normal error of this size (cells) is rounded to 0, +1 or more, −1 or less."""
    stays = erf(0.5 / (sigma * sqrt(2.0))) if sigma > 0.0 else 1.0
    return stays, (1.0 - stays) / 2, (1.0 - stays) / 2
