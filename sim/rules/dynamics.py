"""How an autonomous vehicle moves: which moves it has, where each leads, and what it sweeps on the way.

A motion is a class with a name (`Config.dynamics`) that says one thing, `step`: from a cell by a move to
another cell, and what is swept. All else is derived from that, cell by cell: where sets of vehicles may be
next, and where they may have come from. Search, forecast, commit and judge ask it. For today's motion
(`sim.rules.grid_dynamics`) the derived sets are replaced by operations on whole boards, which the tests
compare with the derived ones on every road.

A further motion is a class in a module of its own, named in `sim.rules.dynamics_registry`. No move of it may
lead back.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, ClassVar, Final, NamedTuple

from sim.rules.ego_contacts import Denied, paths_touch
from sim.rules.ego_step import Steps
from sim.types import MOVES, Move
from sim.world.grid import Board, Road, bits, board_of

DEFAULT_DYNAMICS: Final = "grid"

NOTHING: Final[tuple[int, ...]] = ()


class Swept(NamedTuple):
    """What a step sweeps, as cell indices. The step is free if none of it is met.

    Bodies and times within the tick are accounted for already (`sim.rules.collision_geometry`).
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
        self.target: Callable[[int, Move], int | None] = lru_cache(maxsize=4_096)(self._target)
        """the cell a move leads to; None if that is off the road"""
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
        """The cells that forward moves reach, if only their end cells can collide; otherwise none."""
        return 0

    def egos_touch(self, one: tuple[int, int], other: tuple[int, int]) -> bool:
        """Whether two egos touch that go straight from a cell to another each; cell indices, (start, end)."""
        (start, end), (start_of_other, end_of_other) = one, other
        cell = self.road.cell
        path, path_of_other = (cell(start), cell(end)), (cell(start_of_other), cell(end_of_other))
        return paths_touch(path, path_of_other, "swept" if self.bodies else "cell")

    def denied(self, cell: int, move: Move) -> tuple[Denied, ...]:
        """For every move, in the order of `MOVES`, what another ego denies that makes `move` from `cell`."""
        end = self.target(cell, move)
        theirs = cell, cell if end is None else end
        starts, ends = [0] * len(MOVES), [0] * len(MOVES)
        for start in range(self.road.columns * self.road.rows):
            for step in self._from(start):
                if start != cell and self.egos_touch((start, step.end), theirs):
                    starts[step.place] |= 1 << start
                    ends[step.place] |= 1 << step.end
        return tuple(map(Denied, starts, ends))

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

    def _target(self, cell: int, move: Move) -> int | None:
        found = self.step(cell, move)
        return None if found is None else found[0]

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
