"""How an autonomous vehicle moves: which moves it has, where each leads, and what it sweeps on the way.

A motion is a class with a name (`Config.dynamics`) that says one thing, `step`: from a cell by a move to
another cell, and what is swept. All else is derived from that, cell by cell: where sets of vehicles may be
next, and where they may have come from. Search, forecast, commit and judge ask it. `GridDynamics` is today's
motion; for it the derived sets are replaced by whole-board operations (`sim.rules.ego_step`), which the tests
compare with the derived ones on every road.

A further motion is a class here or in a module of its own, named in `DYNAMICS`. It never leads back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, ClassVar, Final, NamedTuple

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
from sim.types import MOVES, Move
from sim.world.grid import Board, Road, bits, board_of

NOTHING: Final[tuple[int, ...]] = ()


class Swept(NamedTuple):
    """What a step sweeps, as cell indices. The step is free if none of it is met.

    Bodies and times within the tick are accounted for already (`sim.rules.bodies`).
    """

    cells: tuple[int, ...]
    """cells in which nothing may be after the tick; where the step ends comes first"""
    from_left: tuple[int, ...] = NOTHING
    """cells that no mover may enter by a step to the right (from column − 1) in this tick"""
    from_right: tuple[int, ...] = NOTHING
    """cells that no mover may enter by a step to the left (from column + 1) in this tick"""


class Obstacles(NamedTuple):
    """What the steps of one tick may meet."""

    blocked: Board
    """cells taken after the tick"""
    came_right: Board
    """cells that movers entered by a step to the right"""
    came_left: Board


class _Step(NamedTuple):
    """A step as boards. `place`: the index of its move in `MOVES`."""

    place: int
    end: int
    cells: Board
    from_left: Board
    from_right: Board


class Dynamics:
    """The motion on one road. A subclass gives `name`, `rows_a_tick` and `step`."""

    name: ClassVar[str]
    rows_a_tick: ClassVar[int]
    """the most rows that a move leads on; no move leads back"""

    def __init__(self, road: Road, *, bodies: bool) -> None:
        """`bodies`: whether bodies of stated size collide within a tick (`collision: swept`), or cells."""
        self.road = road
        self.bodies = bodies
        self._columns = road.columns
        self.swept: Callable[[int, int], Swept] = lru_cache(maxsize=4_096)(self._swept)
        """what the step from one cell to another sweeps; the end alone where no move leads there"""
        self._steps_from: dict[int, tuple[_Step, ...]] = {}
        self._sources_of: dict[int, tuple[tuple[int, _Step], ...]] = {}

    # What a motion is

    def step(self, cell: int, move: Move) -> tuple[int, Swept] | None:
        """The cell that a move leads to and what it sweeps on the way; None if it leads off the road."""
        raise NotImplementedError

    # What follows from it

    def actions(self, cell: int) -> tuple[Move, ...]:
        """The moves from a cell that do not lead off the road."""
        return tuple(MOVES[step.place] for step in self._from(cell))

    def target(self, cell: int, move: Move) -> int | None:
        """The cell a move leads to; None if that is off the road."""
        found = self.step(cell, move)
        return None if found is None else found[0]

    def steps(self, start: Board, blocked: Board, came_right: Board, came_left: Board) -> Steps:
        """Where vehicles in the cells `start` may be one tick later, by move."""
        ends = [0] * len(MOVES)
        for cell in bits(start):
            for place, end in self.free_ends(Obstacles(blocked, came_right, came_left), cell):
                ends[place] |= 1 << end
        return Steps(*ends)

    def spread(self, start: Board, blocked: Board, came_right: Board, came_left: Board) -> Board:
        """All of `steps` together."""
        found = 0
        for ends in self.steps(start, blocked, came_right, came_left):
            found |= ends
        return found

    def spread_back(self, end: Board, blocked: Board, came_right: Board, came_left: Board) -> Board:
        """Every cell from which a move that meets nothing leads into a cell of `end`, all of them free."""
        return board_of(
            start
            for cell in bits(end)
            for start, step in self._to(cell)
            if not (step.cells & blocked or step.from_left & came_right or step.from_right & came_left)
        )

    def obstacles(self, blocked: Board, came_right: Board, came_left: Board) -> Any:
        """What `free_ends` asks for, made once for all cells of a tick."""
        return Obstacles(blocked, came_right, came_left)

    def free_ends(self, obstacles: Any, cell: int, origin: int = 0) -> list[tuple[int, int]]:
        """(place in `MOVES`, cell) of every move from a cell that meets nothing, in the order of moves.

        The cells are counted from `origin`, which is not beyond any cell that a move leads to.
        """
        blocked, came_right, came_left = obstacles
        return [
            (step.place, step.end - origin)
            for step in self._from(cell)
            if not (step.cells & blocked or step.from_left & came_right or step.from_right & came_left)
        ]

    def unhindered(self, start: Board) -> Board:  # noqa: ARG002 - nothing is known of a motion in general
        """Where going forward leads if only what is there afterwards can be met; nowhere if more can be."""
        return 0

    def ends_anywhere(self, start: Board) -> Board:
        """Where moves lead from `start`, whatever is there."""
        return board_of(step.end for cell in bits(start) for step in self._from(cell))

    def may_come_from(self, end: Board, entered: Board) -> Board:
        """The cells from which a move leads into `end` in their own row, or into `entered` in another."""
        columns = self.road.columns
        return board_of(
            start
            for cell in bits(end | entered)
            for start, _ in self._to(cell)
            if (end if start // columns == cell // columns else entered) >> cell & 1
        )

    def _swept(self, start: int, end: int) -> Swept:
        found = (self.step(start, move) for move in MOVES)
        return next((step[1] for step in found if step is not None and step[0] == end), Swept((end,)))

    def _from(self, cell: int) -> tuple[_Step, ...]:
        found = self._steps_from.get(cell)
        if found is None:
            steps = ((place, self.step(cell, move)) for place, move in enumerate(MOVES))
            found = self._steps_from[cell] = tuple(
                _Step(
                    place,
                    step[0],
                    board_of(step[1].cells),
                    board_of(step[1].from_left),
                    board_of(step[1].from_right),
                )
                for place, step in steps
                if step is not None
            )
        return found

    def _to(self, cell: int) -> tuple[tuple[int, _Step], ...]:
        found = self._sources_of.get(cell)
        if found is None:
            columns = self.road.columns
            row = cell // columns
            last = min(self.road.rows, row + self.rows_a_tick + 1)
            found = self._sources_of[cell] = tuple(
                (start, step)
                for start in range(row * columns, last * columns)
                for step in self._from(start)
                if step.end == cell
            )
        return found


class GridMasks(NamedTuple):
    """What steps meet in one tick on the grid: the cells taken, and the cells a move cannot start from."""

    blocked: Board
    closed: ClosedStarts


class GridDynamics(Dynamics):
    """A cell a tick: forward, aside, diagonally forward, or none. Sets of cells by whole boards."""

    name = "grid"
    rows_a_tick = 1

    def step(self, cell: int, move: Move) -> tuple[int, Swept] | None:
        """See `Dynamics`. Aside, a mover that comes the other way is met; diagonally, one from that side.

        A diagonal meets a mover that comes from its side into the cell left or the one straight ahead
        (`sim.rules.bodies` derives that); where only cells collide, it does not.
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

    def target(self, cell: int, move: Move) -> int | None:
        """See `Dynamics`."""
        return self.road.moved(cell, move)

    def steps(self, start: Board, blocked: Board, came_right: Board, came_left: Board) -> Steps:
        """See `Dynamics`."""
        road = self.road
        columns = road.columns
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

    def ends_anywhere(self, start: Board) -> Board:
        """See `Dynamics`."""
        road = self.road
        return beside(start | start >> road.columns, road.left_edge, road.right_edge)

    def may_come_from(self, end: Board, entered: Board) -> Board:
        """See `Dynamics`."""
        road = self.road
        behind = beside(entered, road.left_edge, road.right_edge) << road.columns
        return (beside(end, road.left_edge, road.right_edge) | behind) & road.all


DYNAMICS: Final[Mapping[str, type[Dynamics]]] = {each.name: each for each in (GridDynamics,)}
"""Every motion by its name in `Config.dynamics`."""
DEFAULT_DYNAMICS: Final = GridDynamics.name

_latest: tuple[Road, str, bool, Dynamics] | None = None


def dynamics_on(road: Road, name: str = DEFAULT_DYNAMICS, bodies: bool = True) -> Dynamics:
    """The motion of that name on a road; mostly one object for the same question."""
    global _latest
    # The latest answer: it is asked for three times a tick, and even a look into a table adds up.
    latest = _latest
    if latest is not None and latest[0] is road and latest[1] == name and latest[2] is bodies:
        return latest[3]
    motion = _made(road.columns, road.rows, name, bodies)
    _latest = road, name, bodies, motion
    return motion


@lru_cache(maxsize=128)
def _made(columns: int, rows: int, name: str, bodies: bool) -> Dynamics:
    return DYNAMICS[name](Road.of(columns, rows), bodies=bodies)
