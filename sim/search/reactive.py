"""The least ticks to the goal where movers react to the vehicle: exact, with every draw known.

A mover that gives way or brakes goes on from another cell than in the roll-out without a vehicle, but only in
the vehicle's own row: rows are independent, and the vehicle never goes back. So a state is the vehicle's cell
and what its row holds, and a row that is entered is as the roll-out has it. Structure: breadth-first search
by ticks; vehicles in rows that hold the same are one set of columns. Guarantee: no way of fewer ticks exists,
since every move in every state is tried with the reactions it causes. Source: time-expanded breadth-first
search (Silver, "Cooperative pathfinding", 2005), with the part of the environment that reacts in the state.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from sim.config import Config
from sim.forecast import Forecast
from sim.rules.kinds import resting_marked, shift_marked
from sim.rules.traffic import Motion, brake, free_steps, move_movers
from sim.rules.yielding import attentive_movers, yielding_movers
from sim.search.dead_ends import cells_that_may_arrive
from sim.types import Move
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, bits

_MOVES = tuple(Move)


class ImpatientError(Exception):
    """The search was given up: more states were met than were to be looked at."""


class Row(NamedTuple):
    """What one row holds: its number, and the movers of that row as a board of its columns."""

    number: int
    right: Board
    left: Board
    marked: tuple[Board, ...]
    """the movers of each kind in `MARKED`; empty where there are none"""


Layer = dict[Row, Board]
"""The columns the vehicle may be in, by what its row holds."""


@dataclass(slots=True)
class ReactiveSearch:
    """The search from one moment. `forecast` is that of the moment, and reaches to the limit."""

    world: World
    config: Config
    forecast: Forecast
    patience: int | None = None
    """states that are looked at before it is given up; None: all there are"""

    def least_ticks(self, limit: int) -> int | None:
        """Ticks of a quickest way to row 0 within `limit` ticks; None if there is none.

        Raises `ImpatientError`, as `plan` does.
        """
        found = self._layers(limit)
        return None if found is None else len(found) - 1

    def plan(self, limit: int) -> tuple[Move, ...] | None:
        """The moves of a quickest way, earlier moves of `Move` preferred; None if there is none."""
        layers = self._layers(limit)
        if layers is None:
            return None
        row = next(row for row in layers[-1] if row.number == 0)
        column = next(bits(layers[-1][row]))
        moves = []
        for ahead in range(len(layers) - 2, -1, -1):
            row, column, move = next(
                (before, start, _MOVES[index])
                for before, columns in layers[ahead].items()
                if before.number - row.number in (0, 1)
                for start in bits(columns)
                for index, there, end in self._steps(before, start, ahead)
                if there == row and end == column
            )
            moves.append(move)
        return tuple(reversed(moves))

    def _layers(self, limit: int) -> list[Layer] | None:
        """The states reached after 0, 1, ... ticks, up to the first in row 0; None if there is none."""
        world = self.world
        number, column = divmod(world.av, world.road.columns)
        first = self._row(number, world.right, world.left, _marked(world.boards))
        layers: list[Layer] = [{first: 1 << column}]
        if number == 0:
            return layers
        # Nearly all states are too late, or shut off whoever reacts.
        hopeful = cells_that_may_arrive(self.forecast, limit)
        if not hopeful[0] >> world.av & 1:
            return None
        looked_at = 0
        while len(layers) <= limit:
            after: Layer = {}
            looked_at += sum(columns.bit_count() for columns in layers[-1].values())
            if self.patience is not None and looked_at > self.patience:
                raise ImpatientError
            for row, columns in layers[-1].items():
                for start in bits(columns):
                    for _, there, end in self._steps(row, start, len(layers) - 1):
                        after[there] = after.get(there, 0) | 1 << end
            after = self._kept(after, hopeful[len(layers)])
            layers.append(after)
            if any(row.number == 0 for row in after):
                return layers
            if not after:
                return None
        return None

    def _kept(self, layer: Layer, hopeful: Board) -> Layer:
        """The states of a layer from which the goal may still be reached."""
        columns = self.world.road.columns
        kept = {row: there & hopeful >> row.number * columns for row, there in layer.items()}
        return {row: there for row, there in kept.items() if there}

    def _steps(self, row: Row, column: int, ahead: int) -> Iterator[tuple[int, Row, int]]:
        """The moves that meet nothing: place in `Move`, the row after it, and the column."""
        columns = self.world.road.columns
        bit, last = 1 << column, 1 << columns - 1
        fixed = self._fixed(row.number)
        moved, stood = self._motions(row, column, fixed, ahead)
        swept = self.forecast.swept
        slices = self.forecast.slices
        below = row.number * columns
        whole = (1 << columns) - 1
        on_start = below - columns
        coming = slices[ahead]
        on_right, on_left = coming.came_right >> on_start & whole, coming.came_left >> on_start & whole
        cut_left = (moved.came_right | on_right) if swept else 0
        cut_right = (moved.came_left | on_left) if swept else 0
        blocked_on = self._fixed(row.number - 1) | coming.occupied >> on_start & whole
        own = free_steps(bit, 0, fixed | moved.occupied, moved.came_right, moved.came_left, 0, 0, 1, last)
        on = free_steps(0, bit, blocked_on, 0, 0, cut_left, cut_right, 1, last)
        here = self._after(row, moved)
        front = self._entered(row.number - 1, ahead)
        for index, (there, end) in enumerate(
            (
                (front, on.forward),
                (here, own.left),
                (here, own.right),
                (front, on.forward_left),
                (front, on.forward_right),
            )
        ):
            if end:
                yield index, there, end.bit_length() - 1
        if not bit & (fixed | stood.occupied):
            yield len(_MOVES) - 1, self._after(row, stood), column

    def _motions(self, row: Row, column: int, fixed: Board, ahead: int) -> tuple[Motion, Motion]:
        """The movers of the row in this tick while the vehicle leaves its cell, and while it stands."""
        world, config = self.world, self.config
        columns, bit = world.road.columns, 1 << column
        moving = row.right | row.left
        disabled = moving & (world.boards.holding >> row.number * columns & (1 << columns) - 1)
        giving = braking = 0
        if moving & (bit << 1 | bit >> 1):
            giving, braking = self._reacting(row, column, ahead)
        moved = move_movers(
            row.right,
            row.left,
            disabled | resting_marked(row.marked, world.episode_tick + ahead) if row.marked else disabled,
            fixed,
            giving,
            bit if config.courtesy else 0,
            1,
            1 << columns - 1,
        )
        return moved, brake(moved, bit, braking) if braking else moved

    def _reacting(self, row: Row, column: int, ahead: int) -> tuple[Board, Board]:
        """The movers of the row that give way, and those that brake, in this tick: as they are drawn."""
        world, below = self.world, row.number * self.world.road.columns
        whole = (1 << world.road.columns) - 1
        there = replace(
            world,
            tick=world.tick + ahead,
            avs=(below + column,),
            right=row.right << below,
            left=row.left << below,
        )
        return (
            yielding_movers(there, self.config) >> below & whole,
            attentive_movers(there, self.config) >> below & whole,
        )

    def _after(self, row: Row, motion: Motion) -> Row:
        return Row(row.number, motion.right, motion.left, shift_marked(row.marked, motion))

    def _entered(self, number: int, ahead: int) -> Row:
        """A row that no vehicle has been in, after this tick."""
        motion = self.forecast.slices[ahead]
        return self._row(number, motion.right, motion.left, _marked(self.forecast.slices.boards(ahead)))

    def _row(self, number: int, right: Board, left: Board, marked: tuple[Board, ...]) -> Row:
        columns = self.world.road.columns
        below, whole = number * columns, (1 << columns) - 1
        here = tuple([board >> below & whole for board in marked])
        return Row(number, right >> below & whole, left >> below & whole, here if any(here) else ())

    def _fixed(self, number: int) -> Board:
        columns = self.world.road.columns
        return self.world.fixed >> number * columns & (1 << columns) - 1


def _marked(boards: Boards) -> tuple[Board, ...]:
    return boards.marked if boards.others else ()
