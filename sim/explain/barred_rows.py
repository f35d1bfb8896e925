"""The rows of barriers ahead: which lanes they close, which are free, and which of those can be got to.

By the road as it is. A lane of a row is closed where a barrier or a pothole stands in it; who only drives
through it closes nothing. That a free cell is got to, and that a way to the goal leads through it, is
searched in the forecast in which nobody reacts; that it cannot be got to, among the things that stand.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from sim.forecast import Forecast
from sim.search.reachability import steps_left
from sim.state import SimState
from sim.types import Kind, Outcome
from sim.world.grid import Board

ROWS_AHEAD: Final = 3
"""How many times the rows of the road a way is looked for, in ticks."""


@dataclass(frozen=True, slots=True)
class BarredRow:
    """One row ahead with barriers in it. Lanes count from 1 at the left."""

    row: int
    """the row of the road; 0 is the goal"""
    ahead: int
    """how many rows it is ahead"""
    barriers: tuple[int, ...]
    """the lanes that hold a barrier"""
    potholes: tuple[int, ...]
    """the lanes that hold a pothole and no barrier"""
    free: tuple[int, ...]
    """all others"""


@dataclass(frozen=True, slots=True)
class Gap:
    """A free lane of a row, as far as the ego is concerned."""

    lane: int
    ticks: int | None
    """after how many ticks the ego can be in it; None where no way to it was found"""
    shut_off: bool
    """whether what stands on the road keeps the ego from it whatever else moves"""
    leads_on: bool
    """whether a way to the goal was found that goes through it"""


@dataclass(frozen=True, slots=True)
class BarredRows:
    """The rows of barriers ahead, the nearest first."""

    state: SimState
    rows: tuple[BarredRow, ...]
    gaps: tuple[Gap, ...]
    """those of the nearest row; none where the drive has ended"""


def barred_rows(state: SimState) -> BarredRows:
    """What barriers close ahead of the first ego: rows with two of them or more, else those with one."""
    world = state.world
    road, own = world.road, world.road.cell(world.av)[1]
    found = [_row(state, row) for row in reversed(range(own))]
    with_some = [each for each in found if each.barriers]
    several = [each for each in with_some if len(each.barriers) > 1]
    rows = tuple(several or with_some)
    running = world.outcome is Outcome.RUNNING
    gaps = _gaps(state, rows[0]) if rows and running else ()
    assert all(len(each.barriers + each.potholes + each.free) == road.columns for each in rows)
    return BarredRows(state, rows, gaps)


def _row(state: SimState, row: int) -> BarredRow:
    world = state.world
    road, own = world.road, world.road.cell(world.av)[1]
    boards = {kind: world.board(kind) for kind in (Kind.BARRIER, Kind.POTHOLE)}
    closed = {
        kind: [lane for lane in range(road.columns) if board >> road.index((lane, row)) & 1]
        for kind, board in boards.items()
    }
    barriers = closed[Kind.BARRIER]
    potholes = [lane for lane in closed[Kind.POTHOLE] if lane not in barriers]
    free = [lane for lane in range(road.columns) if lane not in (*barriers, *potholes)]
    return BarredRow(
        row, own - row, *(tuple(lane + 1 for lane in each) for each in (barriers, potholes, free))
    )


def _gaps(state: SimState, row: BarredRow) -> tuple[Gap, ...]:
    """Each free lane of the row."""
    world, config = state.world, state.config
    limit = min(steps_left(config, world.episode_tick), ROWS_AHEAD * world.road.rows)
    if limit < 1:
        return ()
    forecast = Forecast.of_truth(world, config, limit)
    there = [1 << forecast.ego, *forecast.spreads(1 << forecast.ego, 0, limit)]
    ever = _past_what_stands(forecast)
    cells = {lane: world.road.index((lane - 1, row.row)) for lane in row.free}
    found = []
    for lane, cell in cells.items():
        ticks = next((tick for tick, board in enumerate(there) if board >> cell & 1), None)
        leads = ticks is not None and config.free_ways_hold and _leads_on(forecast, there, cell)
        found.append(Gap(lane, ticks if config.free_ways_hold else None, not ever >> cell & 1, leads))
    return tuple(found)


def _past_what_stands(forecast: Forecast) -> Board:
    """Every cell that can be got to if nothing moves but the ego, and movers are not there."""
    board, before = 1 << forecast.ego, 0
    while board != before:
        before = board
        board |= forecast.dynamics.spread(board, forecast.fixed, 0, 0)
    return board


def _leads_on(forecast: Forecast, there: Sequence[Board], cell: int) -> bool:
    """Whether the goal is reached by a way through a cell."""
    goal, through = forecast.road.row(0), 0
    for ahead, board in enumerate(there):
        through |= board & 1 << cell
        if through & goal:
            return True
        if ahead < len(there) - 1:
            through = forecast.spread(through, ahead) if through else 0
    return False
