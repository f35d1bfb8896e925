"""What a sensor that errs believes of single cells: how likely one is taken, and which no device sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sim.decide import sense
from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.types import HAZARDS, MOVERS, PLACEABLE, Cell, Kind, Move

if TYPE_CHECKING:
    from sim.perceive.belief import Layers


@dataclass(frozen=True, slots=True)
class CellBelief:
    """What the first ego believes of the cell that a move leads to."""

    cell: Cell | None
    """None is off the road"""
    faithful: bool
    """whether the sensor shows what is there"""
    taken: float | None
    """the likelihood that anything is there now; None for a sensor without a grid of likelihoods"""
    likeliest: Kind | None
    """of the kinds of things, the one that is believed there most"""
    shown: Kind | None
    """what counts as being there"""
    truth: Kind | None
    """what is really there"""


@dataclass(frozen=True, slots=True)
class UnknownCells:
    """Which cells from the first ego's row on to the goal none of its devices sees in this tick."""

    faithful: bool
    cells: int
    """all cells from the row of the ego on to the goal, but its own"""
    beyond: int
    """of those: in rows farther ahead than any device sees"""
    unseen: int
    """of those within these rows: hidden behind bodies or beside the field of view"""
    rows: int
    """rows ahead of which any cell is seen"""
    metres: float
    """the same in metres"""


def cell_belief(state: SimState, move: Move) -> CellBelief:
    """What is believed of the cell that a move leads to, from here; `taken` before anything moves on."""
    world, road = state.world, state.world.road
    column, row = road.cell(world.av)
    across, along = move.offset
    cell = column + across, row + along
    faithful = sensor_named(state.config.sensor).faithful
    if not (0 <= cell[0] < road.columns and 0 <= cell[1] < road.rows):
        return CellBelief(None, faithful, None, None, None, None)
    percept, belief = sense(state)
    shown = next((thing.kind for thing in percept.things() if thing.cell == cell), None)
    truth = next((thing.kind for thing in world.things() if thing.cell == cell), None)
    if faithful or state.config.sensor not in SUITES:
        return CellBelief(cell, faithful, None, None, shown, truth)
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.belief import GridBelief, unpacked

    if not isinstance(belief, GridBelief):
        return CellBelief(cell, faithful, None, None, shown, truth)
    layers = unpacked(belief.layers, road)
    by_kind = _by_kind(layers, cell)
    likeliest = max(PLACEABLE, key=lambda kind: by_kind[kind])
    return CellBelief(cell, faithful, taken_in(layers, cell), likeliest, shown, truth)


def taken_in(layers: Layers, cell: Cell) -> float:
    """How likely anything is in a cell of a belief, each kind by itself."""
    free = 1.0
    for likely in _by_kind(layers, cell).values():
        free *= 1.0 - likely
    return 1.0 - free


def _by_kind(layers: Layers, cell: Cell) -> dict[Kind, float]:
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.belief import LAYER, RIGHT, probabilities

    here = probabilities(layers[:, cell[1], cell[0]])
    by_kind = {kind: float(here[LAYER[kind]]) for kind in HAZARDS}
    for kind in MOVERS:  # a mover heads one way or the other
        by_kind[kind] = min(1.0, float(here[RIGHT[kind]] + here[RIGHT[kind] + 1]))
    return by_kind


def unknown_cells(state: SimState) -> UnknownCells | None:
    """Which cells no device sees in this tick; None for a sensor without tables (`SUITES`)."""
    world, road = state.world, state.world.road
    row = road.cell(world.av)[1]
    cells = (row + 1) * road.columns - 1
    if sensor_named(state.config.sensor).faithful:
        return UnknownCells(True, cells, 0, 0, row, row * state.config.cell_m)
    suite = SUITES.get(state.config.sensor)
    if suite is None:
        return None
    # Needs numpy, which sessions with the perfect sensor do without.
    from sim.perceive.grid_sensor import looks

    seen = 0
    for each in looks(world, state.config, 0, suite):
        seen |= each.visible
    rows = max((row - at for at in range(row + 1) if seen & road.row(at)), default=0)
    before = [at for at in range(row + 1) if row - at <= rows]
    within = sum((road.row(at) & ~seen & ~(1 << world.av)).bit_count() for at in before)
    return UnknownCells(
        False, cells, (row + 1 - len(before)) * road.columns, within, rows, rows * state.config.cell_m
    )
