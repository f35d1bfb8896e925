"""The motion on the grid: a cell a tick, forward, aside, diagonally forward, or none.

`step` says what a step sweeps; sets of cells are stepped by whole boards (`sim.rules.ego_step`).
"""

from __future__ import annotations

from typing import NamedTuple

from sim.rules.dynamics import DEFAULT_DYNAMICS, NOTHING, Dynamics, Swept
from sim.rules.ego_contacts import Denied, denied_steps, egos_touch
from sim.rules.ego_step import (
    ClosedStarts,
    Steps,
    beside,
    closed_starts,
    cut_off,
    free_steps,
    spread,
    spread_back,
)
from sim.types import Move
from sim.world.grid import Board


class GridMasks(NamedTuple):
    """What steps meet in one tick on the grid: the cells taken, and the cells a move cannot start from."""

    blocked: Board
    closed: ClosedStarts


class GridDynamics(Dynamics):
    """A cell a tick: forward, aside, diagonally forward, or none. Sets of cells by whole boards."""

    name = DEFAULT_DYNAMICS
    rows_a_tick = 1

    def step(self, cell: int, move: Move) -> tuple[int, Swept] | None:
        """See `Dynamics`. Aside, a mover that comes the other way is met; diagonally, one from that side.

        A diagonal meets a mover that comes from its side into the cell left or the one straight ahead
        (`sim.rules.collision_geometry` derives that); where only cells collide, it does not.
        """
        end = self.road.moved(cell, move)
        if end is None:
            return None
        across, along = move.offset
        met = NOTHING
        if across and not along:
            met = (cell,)
        elif across and self.bodies:
            met = (cell - self.road.columns, cell)
        return end, Swept((end,), met if across < 0 else NOTHING, met if across > 0 else NOTHING)

    def steps(self, start: Board, blocked: Board, came_right: Board, came_left: Board) -> Steps:
        """See `Dynamics`."""
        road, columns = self.road, self._columns
        cut_left = cut_right = 0
        if self.bodies:
            cut_left, cut_right = cut_off(came_right, came_left, came_right >> columns, came_left >> columns)
        return free_steps(
            start,
            start >> columns,
            blocked,
            came_right,
            came_left,
            cut_left,
            cut_right,
            road.left_edge,
            road.right_edge,
        )

    def spread(self, start: Board, blocked: Board, came_right: Board, came_left: Board) -> Board:
        """See `Dynamics`."""
        road = self.road
        columns = road.columns
        cut_left = cut_right = 0
        if self.bodies:
            cut_left, cut_right = cut_off(came_right, came_left, came_right >> columns, came_left >> columns)
        return spread(
            start,
            start >> columns,
            blocked,
            came_right,
            came_left,
            cut_left,
            cut_right,
            road.left_edge,
            road.right_edge,
        )

    def spread_back(self, end: Board, blocked: Board, came_right: Board, came_left: Board) -> Board:  # noqa: ARG002
        """See `Dynamics`."""
        road = self.road
        columns = road.columns
        cut_left = cut_right = 0
        if self.bodies:
            cut_left, cut_right = cut_off(came_right, came_left, came_right >> columns, came_left >> columns)
        aside, on = spread_back(
            end, came_right, came_left, cut_left, cut_right, road.left_edge, road.right_edge
        )
        return aside | on << columns & road.all

    def obstacles(self, blocked: Board, came_right: Board, came_left: Board) -> GridMasks:
        """See `Dynamics`."""
        road = self.road
        columns = road.columns
        cut_left = cut_right = 0
        if self.bodies:
            cut_left, cut_right = cut_off(came_right << columns, came_left << columns, came_right, came_left)
        edges = road.left_edge, road.right_edge
        return GridMasks(blocked, closed_starts(came_right, came_left, cut_left, cut_right, *edges))

    def free_ends(self, obstacles: GridMasks, cell: int, origin: int = 0) -> list[tuple[int, int]]:
        """See `Dynamics`."""
        taken, (no_left, no_right, no_forward_left, no_forward_right) = obstacles
        blocked = taken >> origin
        here = cell - origin
        on = here - self._columns
        ends = []
        if not blocked >> on & 1:
            ends.append((0, on))
        if not (no_left >> cell | blocked >> here - 1) & 1:
            ends.append((1, here - 1))
        if not (no_right >> cell | blocked >> here + 1) & 1:
            ends.append((2, here + 1))
        if not (no_forward_left >> cell & 1) and not blocked >> on - 1 & 1:
            ends.append((3, on - 1))
        if not (no_forward_right >> cell | blocked >> on + 1) & 1:
            ends.append((4, on + 1))
        if not blocked >> here & 1:
            ends.append((5, here))
        return ends

    def unhindered(self, start: Board) -> Board:
        """See `Dynamics`: nobody is met on the way straight on."""
        return start >> self.road.columns

    def egos_touch(self, one: tuple[int, int], other: tuple[int, int]) -> bool:
        """See `Dynamics`: looked up in the table of contacts."""
        return egos_touch(self.road, one, other, "swept" if self.bodies else "cell")

    def denied(self, cell: int, move: Move) -> tuple[Denied, ...]:
        """See `Dynamics`: made from the table of contacts, once."""
        return denied_steps(self.road.columns, self.road.rows, cell, move, "swept" if self.bodies else "cell")

    def ends_anywhere(self, start: Board) -> Board:
        """See `Dynamics`."""
        road = self.road
        return beside(start | start >> road.columns, road.left_edge, road.right_edge)

    def may_come_from(self, end: Board, entered: Board) -> Board:
        """See `Dynamics`."""
        road = self.road
        behind = beside(entered, road.left_edge, road.right_edge) << road.columns
        return (beside(end, road.left_edge, road.right_edge) | behind) & road.all
