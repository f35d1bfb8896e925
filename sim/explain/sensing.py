"""How far the sensor detects anything in this weather and light, and what it gets wrong at present."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import floor
from typing import Final

from sim.config import Config
from sim.explain.misperception import Misperception, misperception
from sim.perceive import sensor_named
from sim.perceive.detection import detection_chance
from sim.perceive.parameters import MAX_REACH, SUITES
from sim.state import SimState
from sim.types import PLACEABLE, Cell, Kind

HALF: Final = 0.5
"""The share of single looks that detect a thing, up to the distance that is told."""


@dataclass(frozen=True, slots=True)
class Reach:
    """How far a sensor detects things in plain view, right ahead."""

    metres: float
    cells: int
    """whole cells ahead within these metres"""
    half: Mapping[Kind, int]
    """cells ahead up to which one look detects a thing of a kind in at least half of the cases"""


@dataclass(frozen=True, slots=True)
class Sensing:
    """What the sensor of the first ego is worth at present."""

    state: SimState
    faithful: bool
    """whether it shows what is there, whatever the weather"""
    reach: Reach | None
    """None where it is faithful, and for a sensor of another package"""
    wrong: Misperception
    things: int
    """things on the road"""

    def cells_to(self, cell: Cell) -> int:
        """How far a cell is from the ego, across or along the road."""
        column, row = self.state.world.road.cell(self.state.world.av)
        return max(abs(cell[0] - column), abs(cell[1] - row))

    def of_kind(self, kind: Kind) -> Sensing:
        """The same of the things of one kind alone."""
        return replace(self, wrong=self.wrong.of(kind), things=self.state.world.count(kind))

    @property
    def out_of_range(self) -> int:
        """How many of the things that are missed are farther ahead than the sensor reaches, or behind."""
        if self.reach is None:
            return 0
        row = self.state.world.road.cell(self.state.world.av)[1]
        return sum(not 0 <= row - thing.cell[1] <= self.reach.cells for thing in self.wrong.missed)

    @property
    def blind(self) -> bool:
        """Whether half of the looks detect nothing even in the cell ahead, or all things are missed."""
        if self.reach is not None and not any(self.reach.half.values()):
            return True
        return bool(self.things) and len(self.wrong.missed) == self.things


def sensing(state: SimState) -> Sensing:
    """What the sensor is worth in this state."""
    faithful = sensor_named(state.config.sensor).faithful
    things = sum(1 for _ in state.world.things())
    return Sensing(state, faithful, None if faithful else reach(state.config), misperception(state), things)


def reach(config: Config) -> Reach | None:
    """How far the configured sensor detects; None for one that the tables do not have (`SUITES`)."""
    if config.sensor not in SUITES:
        return None
    metres = max(
        spec.range_m * min(spec.weather[config.weather].reach, spec.light[config.time_of_day].reach)
        for spec in SUITES[config.sensor]
    )
    metres = min(metres, config.sensor_range_m)
    cells = min(MAX_REACH, floor(metres / config.cell_m))
    half = {
        kind: max(
            (
                rows
                for rows in range(1, cells + 1)
                if (detection_chance(config, kind, rows * config.cell_m) or 0.0) >= HALF
            ),
            default=0,
        )
        for kind in PLACEABLE
    }
    return Reach(metres, cells, half)
