"""The least ticks to the goal where movers react to the ego: exact, with every draw known.

A mover that gives way or brakes goes on from another cell than in the roll-out without a vehicle, but only in
the ego's own row: rows are independent, and the ego never goes back. So a state is the ego's cell
and what its row holds, and a row that is entered is as the roll-out has it. Structure: breadth-first search
by ticks; vehicles in rows that hold the same are one set of columns. Guarantee: no way of fewer ticks exists,
since every move in every state is tried with the reactions it causes. Source: time-expanded breadth-first
search (Silver, "Cooperative pathfinding", 2005), with the part of the environment that reacts in the state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from sim.config import Config
from sim.fast_replace import field_setter
from sim.forecast import Forecast
from sim.rules.behaviour import NOBODY, Behaviour, Reactions
from sim.rules.dynamics import Dynamics
from sim.rules.dynamics_registry import dynamics_on
from sim.rules.ego_step import Steps
from sim.rules.mover_boards import shift_marked, with_marked
from sim.rules.traffic import Motion
from sim.search.dead_ends import cells_that_may_arrive
from sim.types import MOVES, Move
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, Road, bits, board_of

SPARE_TICKS: Final = (1, 5, 20)
"""A way is looked for in so many ticks more than the rows take, in turn, before it is in the whole limit."""


class ImpatientError(Exception):
    """The search was given up: more states were met than were to be looked at."""


class Row(NamedTuple):
    """What one row holds: its number, and the movers of that row as a board of its columns."""

    number: int
    right: Board
    left: Board
    marked: tuple[Board, ...]
    """the movers of each kind in `MARKED`; empty where there are none"""


class Surroundings(NamedTuple):
    """What a tick holds for all vehicles in one row: their row and those a move may lead to, as a road."""

    steps: Callable[[Board, Board, Board, Board], Steps]
    """the motion on that road (`Dynamics.steps`)"""
    below: int
    """the index of its first cell on the whole road"""
    before: int
    """its cells before the ego's row"""
    unmoved: Board
    """what does not move, in any row"""
    taken: Board
    """where movers are after the tick, in the rows before the ego's; so are the next two"""
    came_right: Board
    came_left: Board
    fixed: Board
    """columns of the ego's row that are taken by what does not move"""
    holding: Board
    """columns in which movers are held"""
    entered: dict[int, Row]
    """what the rows before hold after the tick, filled as they are entered"""


Layer = dict[Row, Board]
"""The columns the ego may be in, by what its row holds."""


@dataclass(slots=True)
class ReactiveSearch:
    """The search from one moment. `forecast` is that of the moment, and reaches to the limit."""

    world: World
    config: Config
    forecast: Forecast
    patience: int | None = None
    """states that are looked at before it is given up; None: all there are"""
    _windows: tuple[Dynamics, ...] = field(init=False)
    """the motion on a road of so many rows ahead of the ego"""
    _behaviour: Behaviour = field(init=False)
    _ahead: int = field(init=False)
    _around: dict[int, Surroundings] = field(init=False)
    """by number of the row, `_ahead` ticks from now: the latest tick that was asked about"""

    def __post_init__(self) -> None:
        dynamics, columns = self.forecast.dynamics, self.world.road.columns
        self._windows = tuple(
            dynamics_on(Road.of(columns, ahead + 1), dynamics.name, dynamics.bodies)
            for ahead in range(dynamics.rows_a_tick + 1)
        )
        self._behaviour = self.config.mover_behaviour
        self._ahead, self._around = 0, {}

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
        moves, rows_a_tick = [], self.forecast.dynamics.rows_a_tick
        for ahead in range(len(layers) - 2, -1, -1):
            row, column, move = next(
                (before, start, MOVES[index])
                for before, columns in layers[ahead].items()
                if 0 <= before.number - row.number <= rows_a_tick
                for start in bits(columns)
                for index, there, end in self.steps(before, start, ahead)
                if there == row and end == column
            )
            moves.append(move)
        return tuple(reversed(moves))

    def _layers(self, limit: int) -> list[Layer] | None:
        """The states reached after 0, 1, ... ticks, up to the first in row 0; None if there is none.

        Looked for is a way in few ticks first: then most states are too late, and the first in row 0 is as
        soon as it would be within the whole limit.
        """
        forecast = self.forecast
        fewest = -(-(self.world.av // self.world.road.columns) // forecast.dynamics.rows_a_tick)
        for within in (fewest + more for more in SPARE_TICKS if fewest + more < limit):
            layers = self._layers_within(within)
            if layers is not None:
                return layers
        return self._layers_within(limit)

    def _layers_within(self, limit: int) -> list[Layer] | None:
        """`_layers`, each of so many ticks looked for at once."""
        world = self.world
        first, column = self.start()
        layers: list[Layer] = [{first: 1 << column}]
        if first.number == 0:
            return layers
        # Nearly all states are too late, or shut off whoever reacts.
        hopeful = cells_that_may_arrive(self.forecast, limit)
        if not hopeful[0] >> world.av & 1:
            return None
        looked_at = 0
        for ahead in range(limit):
            after: Layer = {}
            if self.patience is not None:
                looked_at += sum(columns.bit_count() for columns in layers[-1].values())
                if looked_at > self.patience:
                    raise ImpatientError
            for row, columns in layers[-1].items():
                for start in bits(columns):
                    for _, there, end in self.steps(row, start, ahead):
                        after[there] = after.get(there, 0) | 1 << end
            after = self._kept(after, hopeful[ahead + 1])
            layers.append(after)
            if any(row.number == 0 for row in after):
                return layers
            if not after:
                return None
        return None

    def start(self) -> tuple[Row, int]:
        """The row that the ego is in, and its column."""
        world = self.world
        number, column = divmod(world.av, world.road.columns)
        return self._row(number, world.right, world.left, _marked(world.boards)), column

    def _kept(self, layer: Layer, hopeful: Board) -> Layer:
        """The states of a layer from which the goal may still be reached."""
        columns = self.world.road.columns
        kept = {row: there & hopeful >> row.number * columns for row, there in layer.items()}
        return {row: there for row, there in kept.items() if there}

    def steps(self, row: Row, column: int, ahead: int) -> Iterator[tuple[int, Row, int]]:
        """The moves that meet nothing: place in `Move`, the row after it, and the column."""
        own, columns = row.number, self.world.road.columns
        if ahead != self._ahead:
            self._ahead, self._around = ahead, {}
        around = self._around.get(own)
        if around is None:
            around = self._around[own] = self._surroundings(own, ahead)
        free_steps, below, before, unmoved, taken, came_right, came_left, fixed, holding, entered = around
        moved, stood = self._motions(row, column, fixed, holding, ahead)
        if self.forecast.egos:
            unmoved |= self._taken(own * columns + column, ahead) >> below
        right, left, entered_right, entered_left = moved
        start = 1 << before + column
        steps = free_steps(
            start,
            unmoved | taken | (right | left) << before,
            came_right | entered_right << before,
            came_left | entered_left << before,
        )
        here = self._after(row, moved)
        for index, end in enumerate(steps[:-1]):
            if end:
                number, to = divmod(end.bit_length() - 1 + below, columns)
                if number == own:
                    yield index, here, to
                    continue
                there = entered.get(number)
                if there is None:
                    there = entered[number] = self._entered(number, ahead)
                yield index, there, to
        if stood is moved:
            if steps.stay:
                yield len(MOVES) - 1, here, column
        elif free_steps(
            start,
            unmoved | taken | stood.occupied << before,
            came_right | stood.came_right << before,
            came_left | stood.came_left << before,
        ).stay:
            yield len(MOVES) - 1, self._after(row, stood), column

    def _surroundings(self, number: int, ahead: int) -> Surroundings:
        """What a tick holds for the vehicles in a row."""
        boards, columns = self.world.boards, self.world.road.columns
        window = self._windows[min(number, len(self._windows) - 1)]
        before = (window.road.rows - 1) * columns
        below, front = number * columns - before, (1 << before) - 1
        right, left, came_right, came_left = self.forecast.slices[ahead]
        return Surroundings(
            window.steps,
            below,
            before,
            boards.fixed >> below,
            (right | left) >> below & front,
            came_right >> below & front,
            came_left >> below & front,
            boards.fixed >> number * columns & (1 << columns) - 1,
            boards.holding >> number * columns & (1 << columns) - 1,
            {},
        )

    def _motions(
        self, row: Row, column: int, fixed: Board, holding: Board, ahead: int
    ) -> tuple[Motion, Motion]:
        """The movers of the row in this tick while the ego leaves its cell, and while it stands."""
        world, behaviour = self.world, self._behaviour
        columns, bit = world.road.columns, 1 << column
        moving = row.right | row.left
        reactions = self._reactions(row, column, ahead) if moving & (bit << 1 | bit >> 1) else NOBODY
        moved = behaviour.step(
            row.right,
            row.left,
            row.marked,
            moving & holding,
            fixed,
            1,
            1 << columns - 1,
            world.tick - world.episode_start + ahead,
            bit,
            reactions,
        )
        if self.forecast.egos:
            standing = self._others_standing(row.number, ahead)
            moved = behaviour.brake(moved, standing, Reactions(attentive=(1 << columns) - 1))
        return moved, behaviour.brake(moved, bit, reactions) if (moved.right | moved.left) & bit else moved

    def _taken(self, cell: int, ahead: int) -> Board:
        """The cells that other egos keep the ego from entering, from a cell, in this tick."""
        forecast = self.forecast
        return forecast.taken(ahead) if forecast.egos and (ahead or cell == forecast.ego) else 0

    def _others_standing(self, number: int, ahead: int) -> Board:
        """The columns of a row that other egos stand in throughout this tick."""
        columns, forecast = self.world.road.columns, self.forecast
        standing = forecast.slices.standing
        if not ahead:
            standing &= board_of([other.cell for other in forecast.egos])
        return standing >> number * columns & (1 << columns) - 1

    def _reactions(self, row: Row, column: int, ahead: int) -> Reactions:
        """Who of the row may react in this tick, as it is drawn."""
        world, below = self.world, row.number * self.world.road.columns
        there = _one_row(
            world,
            world.tick + ahead,
            (below + column,),
            row.right << below,
            row.left << below,
            _only(world.boards, row.marked, below),
        )
        found = self._behaviour.reactions(there, self.config)
        return Reactions(found.yielding >> below, found.attentive >> below)

    def _after(self, row: Row, motion: Motion) -> Row:
        marked = row.marked
        return Row(row.number, motion.right, motion.left, shift_marked(marked, motion) if marked else marked)

    def _entered(self, number: int, ahead: int) -> Row:
        """A row that no vehicle has been in, after this tick."""
        motion = self.forecast.slices[ahead]
        return self._row(number, motion.right, motion.left, self.forecast.slices.marked(ahead))

    def _row(self, number: int, right: Board, left: Board, marked: tuple[Board, ...]) -> Row:
        columns = self.world.road.columns
        below, whole = number * columns, (1 << columns) - 1
        here = tuple([board >> below & whole for board in marked])
        return Row(number, right >> below & whole, left >> below & whole, here if any(here) else ())


_one_row = field_setter(World, "tick", "avs", "right", "left", "boards")


def _marked(boards: Boards) -> tuple[Board, ...]:
    return boards.marked if boards.others else ()


def _only(boards: Boards, marked: tuple[Board, ...], below: int) -> Boards:
    """The boards with the movers of one row alone, each kind's in `marked`, its first cell at `below`."""
    if not boards.others:
        return boards
    here = tuple([board << below for board in marked]) or (0,) * len(boards.marked)
    return with_marked(boards, here)
