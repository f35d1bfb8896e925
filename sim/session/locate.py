"""Where a `Where` is: the cells it names on a given road, as seen from the ego, best first.

Lanes and rows are absolute; sides are seen from the ego. "Ahead" without a lane is the
vehicle's own lane for placing, and every lane for finding, the nearest thing first. Another
thing (`Where.of`) may take the place of the ego.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from sim.actions import Landmark, Where
from sim.session.errors import EditError
from sim.types import Cell, Kind
from sim.world import World
from sim.world.grid import Board, Road, bits, board_of, union


@dataclass(frozen=True, slots=True)
class Place:
    """Cells to choose from: the nearest first if `ordered`, else any."""

    cells: Board
    ordered: bool
    origin: int | None = field(default=None, compare=False)
    """the cell index that distances are told from; None: that of the first ego"""

    def nearest_first(self, cells: Board, world: World) -> list[int]:
        """These cells by their distance from where the place is seen."""
        return nearest_to(world.av if self.origin is None else self.origin, bits(cells), world.road)


def nearest_first(cells: Iterable[int], world: World) -> list[int]:
    """Cell indices by distance from the ego; among equals its own lane, then ahead, first."""
    return nearest_to(world.av, cells, world.road)


def nearest_to(ego: int, cells: Iterable[int], road: Road) -> list[int]:
    """Cell indices by distance from the cell `ego`; among equals its own lane, then ahead, first."""
    column, row = road.cell(ego)

    def key(index: int) -> tuple[int, int, bool, int]:
        c, r = road.cell(index)
        return max(abs(c - column), abs(r - row)), abs(c - column), r > row, index

    return sorted(cells, key=key)


def lane_columns(road: Road, lane: str | int) -> list[int]:
    """The columns of a lane; the middle of an even road is two. Raises `EditError`."""
    match lane:
        case "left":
            return [0]
        case "right":
            return [road.columns - 1]
        case "middle":
            return sorted({(road.columns - 1) // 2, road.columns // 2})
        case int() if 1 <= lane <= road.columns:
            return [lane - 1]
    raise EditError("no_such_lane", "where", lane=lane, lanes=road.columns)


def cells_away(where: Where, cell_m: float) -> int | None:
    """The distance said, in whole cells (halves up, at least one), or None if none was said."""
    if where.cells is not None:
        return where.cells
    if where.distance_m is not None:
        return max(1, int(where.distance_m / cell_m + 0.5))
    return None


def place_for_adding(where: Where | None, count: int, world: World, cell_m: float) -> Place:
    """The cells `count` new things may be put in, free or not. Raises `EditError`.

    One thing at a distance has one cell; several spread along that row, or along the lane if one
    was named.
    """
    road = world.road
    if where is None:
        return Place(road.between, ordered=False)
    cells = _absolute(where, road)
    away = cells_away(where, cell_m)
    side = _side(where, away)
    origin = _origin(where.of, world)
    if side is None:
        exact = where.cell is not None or where.row is not None or where.rows is not None
        ordered = bool(where.nearest) or where.of is not None
        return Place(cells if exact else cells & road.between, ordered, origin)
    if side == "beside":
        cells &= _beside(road, origin, away or 1)
    elif _names_no_cells(where):
        cells &= _own_line(road, origin, side, away, spread=count > 1)
    else:
        cells &= _band(road, origin, side, away, open_ended=count > 1)
    return Place(cells, True, origin)


def place_for_finding(where: Where | None, world: World, cell_m: float) -> Place:
    """The cells in which things that are meant may be. Raises `EditError`."""
    if where is None:
        return Place(world.road.all, ordered=True)
    road, cells = world.road, _absolute(where, world.road)
    away = cells_away(where, cell_m)
    side = _side(where, away)
    origin = _origin(where.of, world)
    if side == "beside":
        cells &= _beside(road, origin, away or 1)
    elif side is not None and away is not None and where.lane is None and where.lanes is None:
        cells &= _own_line(road, origin, side, away, spread=False)
    elif side is not None:
        cells &= _band(road, origin, side, away, open_ended=False)
    return Place(cells, True, origin)


def lanes_named(where: Where, road: Road) -> list[int]:
    """The columns that a place names, or all of them, from left to right. Raises `EditError`."""
    cells = _absolute(where, road)
    return [column for column in range(road.columns) if road.column(column) & cells]


def _names_no_cells(where: Where) -> bool:
    """Whether neither lanes, rows nor a cell are named."""
    return (where.lane, where.lanes, where.row, where.rows, where.cell) == (None,) * 5


def _origin(of: Landmark | None, world: World) -> int:
    """The cell index that sides are seen from. Raises `EditError`."""
    if of is None or of.kind == "av":
        return world.av
    if of.id is not None:
        found = world.index_of(of.id)
        if found is None:
            raise EditError("no_such_thing", "where", id=of.id)
        return found[0]
    near = nearest_first(bits(world.board(Kind(str(of.kind)))), world)
    if not near:
        raise EditError("none_there", "where", kind=of.kind, place="road")
    return near[0]


def _side(where: Where, away: int | None) -> str | None:
    """The side said; a bare distance is one ahead."""
    return where.side or ("ahead" if away is not None else None)


def _absolute(where: Where, road: Road) -> Board:
    """The cells that lane, row and cell leave."""
    cells = road.all
    if where.cell is not None:
        if not road.holds(where.cell):
            column, row = where.cell
            raise EditError(
                "cell_off_road",
                "where",
                column=column,
                row=row,
                last_column=road.columns - 1,
                last_row=road.rows - 1,
            )
        cells &= 1 << road.index(where.cell)
    if where.row is not None:
        if not 0 <= where.row < road.rows:
            raise EditError("no_such_row", "where", row=where.row, last_row=road.rows - 1)
        cells &= road.row(where.row)
    if where.rows is not None:
        first, last = sorted(where.rows)
        if last >= road.rows:
            raise EditError("no_such_row", "where", row=last, last_row=road.rows - 1)
        cells &= union(road.row(row) for row in range(first, last + 1))
    if where.lane is not None:
        cells &= union(road.column(column) for column in lane_columns(road, where.lane))
    if where.lanes is not None:
        first, last = (lane_columns(road, lane)[0] for lane in sorted(where.lanes))
        cells &= union(road.column(column) for column in range(first, last + 1))
    return cells


_STEPS: dict[str, Cell] = {"ahead": (0, -1), "behind": (0, 1), "left": (-1, 0), "right": (1, 0)}


def _own_line(road: Road, origin: int, side: str, away: int | None, *, spread: bool) -> Board:
    """The cells straight to one side of a cell; at a distance the one, or several if `spread`."""
    start = road.cell(origin)
    if away is None:
        return _ray(road, start, _STEPS[side], 1)
    cell = cell_away(road, start, side, away)
    if not spread:
        return 1 << road.index(cell)
    return road.row(cell[1]) if side in ("ahead", "behind") else _ray(road, start, _STEPS[side], away)


def _band(road: Road, origin: int, side: str, away: int | None, *, open_ended: bool) -> Board:
    """All rows ahead or behind, or all columns to the left or right; those at a distance if one was said."""
    start = road.cell(origin)
    first = 1 if away is None else away
    if away is not None:
        cell_away(road, start, side, away)
    along = _ray(road, start, _STEPS[side], first)
    lines = 0
    for index in bits(along):
        column, row = road.cell(index)
        if away is None or open_ended or abs(column - start[0]) + abs(row - start[1]) == away:
            lines |= road.row(row) if side in ("ahead", "behind") else road.column(column)
    return lines


def _beside(road: Road, origin: int, away: int) -> Board:
    """The cells so far to the left and right of a cell."""
    column, row = road.cell(origin)
    both = ((column - away, row), (column + away, row))
    return board_of(road.index(cell) for cell in both if road.holds(cell))


def cell_away(road: Road, start: Cell, side: str, away: int) -> Cell:
    """The cell that many cells to one side. Raises `EditError` where the road ends before it."""
    columns, rows = _STEPS[side]
    cell = (start[0] + columns * away, start[1] + rows * away)
    if not road.holds(cell):
        left = _ray(road, start, (columns, rows), 1).bit_count()
        raise EditError("too_far", "where", left=left, side=side, away=away)
    return cell


def _ray(road: Road, start: Cell, step: Cell, first: int) -> Board:
    """The cells from the `first`-th in one direction to the end of the road."""
    board, cell = 0, (start[0] + step[0] * first, start[1] + step[1] * first)
    while road.holds(cell):
        board |= 1 << road.index(cell)
        cell = (cell[0] + step[0], cell[1] + step[1])
    return board
