"""Layouts (families of roads): draws the barriers of a road from a random stream.

Structure: a layout is built band by band from the start to the goal. Each band has its own sub-stream, so a
longer road continues a shorter one. The opening of a band lies away from that of the band before
(`_farther_draw`), so sideways moves are needed. Every band leaves a way through an empty road. Movers are
drawn in the busy rows of a band, with rows to wait in between, and potholes off the way through.
`sim.generation` then searches whether the road can be driven.

- `walls`: a row of barriers every second or third row, with one or two gaps of one cell.
- `narrows`: an open row or two, then a street of one to three lanes for some rows.
- `dead_ends`: corridors side by side, all but one of them closed at their far end.
- `crossing`: no barriers; several vehicles in every row of a band but the last.
- `maze`: rows cut into rooms, with walls between them; some openings lead into closed rooms.

Source: Eller's algorithm builds mazes row by row with an opening each (Buck, "Mazes for Programmers", 2015);
here without passages that lead back, since the ego never moves backwards.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import ceil
from typing import Final, NamedTuple

from sim.actions import Layout
from sim.randomness import Stream
from sim.world.grid import Board, Road, board_of

_CROSSING: Final = 0.7
"""Mean share of cells with a vehicle on a `crossing` road, per unit of spawn probability."""
_STREET: Final = 8
"""A road has one street for every so many columns."""
_DOORS: Final = 16
"""A wall has one more gap, and a band one more open corridor, for every so many columns."""
_LONGEST: Final = 6
"""Rows of the longest street."""
_DEEPEST: Final = 5
"""Rows of the deepest corridor, without the closing row."""
_BUSY: Final = 5
"""Rows of the longest band of crossing traffic."""
_PILLARS: Final = 0.25
"""Share of barriers among the cells of a maze's rooms, off the way through."""
_OPENINGS: Final = 0.15
"""Share of open cells in a maze's walls, besides the way through."""

_SIZE, _SECOND, _FLIP = 0, 1, 2
_PLACES, _CELLS, _WALL = 8, 256, 512
"""Indices of a band's random stream, by purpose."""


class LayoutBoards(NamedTuple):
    """The boards of a layout, between start and goal."""

    barriers: Board
    movers: Board
    """cells where movers are drawn first"""
    potholes: Board
    """cells where potholes are drawn first"""


def lay_out(layout: Layout | None, road: Road, stream: Stream) -> LayoutBoards:
    """Draws the barriers of a layout, and where movers and potholes go; no barriers without a layout."""
    if layout is None:
        return LayoutBoards(0, road.between, road.between)
    columns, barriers, movers, potholes = road.columns, 0, 0, 0
    row, number, through = road.rows - 2, 0, columns // 2
    while row >= 1:
        band = _BANDS[layout](columns, stream.narrow(number), through)
        for line, busy, holes in zip(band.lines[:row], band.busy, band.holes, strict=False):
            start = row * columns
            barriers |= line << start
            movers |= (_movable(line, columns) << start) * busy
            potholes |= (holes & ~line) << start
            row -= 1
        number, through = number + 1, band.through
    return LayoutBoards(barriers, movers, potholes)


def _movable(line: Board, columns: int) -> Board:
    """The free cells of a row with a free neighbour in it: in any other a mover could never move."""
    free = _all_but((), columns) & ~line
    return free & (free << 1 | free >> 1)


def has_barriers(layout: Layout | None) -> bool:
    """Whether a layout places barriers itself; a number of barriers cannot be asked for then."""
    return layout is not None and layout != "crossing"


def min_free_cells(layout: Layout | None, columns: int, rows: int) -> int:
    """A lower bound on the cells between start and goal that are free of barriers, for every seed."""
    between = rows - 2
    match layout:
        case "walls" | "maze":
            # At least every other row is open or a room; in a maze's room only the way is surely free.
            open_rows = -(-between // 2)
            return open_rows * (columns if layout == "walls" else 1) + between - open_rows
        case "narrows":
            return between + -(-between // (_LONGEST + 1)) * (columns - 1)
        case "dead_ends":
            return between + -(-between // (_DEEPEST + 3)) * (columns - 1)
        case _:
            return between * columns


def vehicles_on_average(layout: Layout | None, columns: int, rows: int, spawn_probability: float) -> float:
    """The mean number of obstacle vehicles on a road without an exact number."""
    a_row = spawn_probability * (columns * _CROSSING if layout == "crossing" else 1)
    return (rows - 2) * a_row * _BUSY_SHARE.get(layout, 1.0)


def crossing_vehicles(columns: int, spawn_probability: float, stream: Stream) -> int:
    """Draws the number of vehicles in a row of a `crossing` road: 0.5 to 1.5 times the mean."""
    average = columns * spawn_probability * _CROSSING
    most = min(int(average * 1.5), columns // 2 + columns // 8)
    least = min(ceil(average / 2), most)
    return least + stream.below(max(1, most - least + 1), 0)


class _Band(NamedTuple):
    """A band: some rows, listed from the start towards the goal."""

    lines: list[Board]
    """barriers of each row; bit i is column i"""
    busy: list[bool]
    """whether movers are drawn in each row"""
    holes: list[Board]
    """cells of each row in which potholes are drawn"""
    through: int
    """column in which the way through leaves the band"""


def _alternating(length: int, first: int = 0) -> list[bool]:
    """Marks every second row from `first` on as busy, except the last."""
    return [at % 2 == first and at < length - 1 for at in range(length)]


def _all_but(free: Iterable[int], columns: int) -> Board:
    return (1 << columns) - 1 & ~board_of(free)


def _farther_draw(positions: int, stream: Stream, index: int, before: int) -> int:
    """Draws two positions and returns the one farther from `before`."""
    first, second = stream.below(positions, index), stream.below(positions, index + 1)
    return second if abs(second - before) > abs(first - before) else first


def _inner_column(columns: int, stream: Stream, index: int, before: int) -> int:
    """Draws a column for a gap, never at an edge, where a turning mover could lock in the ego."""
    return 1 + _farther_draw(columns - 2, stream, index, before - 1)


def _walls(columns: int, stream: Stream, through: int) -> _Band:
    gap = _inner_column(columns, stream, _PLACES, through)
    gaps = {gap}
    for extra in range(stream.below(2, _SECOND) + columns // _DOORS):
        column = 1 + stream.below(columns - 2, _PLACES + 2 + extra)
        if not {column - 1, column + 1} & gaps:
            gaps.add(column)
    wall = _all_but(gaps, columns)
    if stream.below(2, _SIZE):
        return _Band([0, 0, wall], [True, False, False], [0, _all_but((), columns), 0], gap)
    return _Band([0, wall], [True, False], [0, 0], gap)


def _narrows(columns: int, stream: Stream, through: int) -> _Band:
    streets = max(1, columns // _STREET)
    free: set[int] = set()
    for street in range(streets):
        first, last = columns * street // streets, columns * (street + 1) // streets
        width = 1 + stream.below(min(3, last - first - 1), _PLACES + 3 * street)
        left = first + _farther_draw(
            last - first - width + 1, stream, _PLACES + 3 * street + 1, through - first
        )
        free.update(range(left, left + width))
        if street == 0:
            through_next = left + width // 2
    busy_first = stream.below(2, _SECOND)
    length = 3 + stream.below(_LONGEST - 2, _SIZE)
    # The row before a street has no movers: an ego at one edge could not reach a street at the other.
    lines = [0] * (1 + busy_first) + [_all_but(free, columns)] * length
    busy = _alternating(len(lines), 1 - busy_first)
    wide = board_of(free) if len(free) == 3 * streets else 0
    holes = [wide * (not moving) for moving in busy]
    holes[: 1 + busy_first] = [0] * (1 + busy_first)
    return _Band(lines, busy, holes, through_next)


def _dead_ends(columns: int, stream: Stream, through: int) -> _Band:
    corridors: list[range] = []
    left = 0
    while left < columns:
        width = 1 + stream.below(2, _PLACES + 4 + len(corridors))
        corridors.append(range(left, min(left + width, columns)))
        left += width + 1
    if stream.below(2, _FLIP):
        corridors = [
            range(columns - corridor.stop, columns - corridor.start) for corridor in reversed(corridors)
        ]
    near = next((at for at, corridor in enumerate(corridors) if corridor.stop >= through), len(corridors) - 1)
    chosen = _farther_draw(len(corridors), stream, _PLACES, near)
    between = _all_but((column for corridor in corridors for column in corridor), columns)
    out = {*corridors[chosen]}
    for extra in range(columns // _DOORS):
        out.update(corridors[stream.below(len(corridors), _CELLS + extra)])
    deep = 2 + stream.below(_DEEPEST - 1, _SIZE)
    lines = [0, 0, *[between] * deep, _all_but(out, columns)]
    holes = [0, 0, *[_all_but(out, columns)] * deep, 0]
    return _Band(lines, _alternating(len(lines)), holes, corridors[chosen].start)


def _crossing(columns: int, stream: Stream, through: int) -> _Band:
    busy = min(2 + stream.below(_BUSY - 1, _SIZE), columns - 1)
    everywhere = _all_but((), columns)
    return _Band([0] * (busy + 1), [True] * busy + [False], [0] * busy + [everywhere], through)


def _maze(columns: int, stream: Stream, through: int) -> _Band:
    gap = _inner_column(columns, stream, _PLACES, through)
    way = range(min(gap, through) - 1, max(gap, through) + 2)
    rooms = [
        column
        for column in range(columns)
        if column not in way and stream.uniform(_CELLS + column) < _PILLARS
    ]
    wall = [
        column
        for column in range(columns)
        if column != gap and (abs(column - gap) == 1 or stream.uniform(_WALL + column) >= _OPENINGS)
    ]
    holes = _all_but((column for column in way if 0 <= column < columns), columns)
    return _Band([board_of(rooms), board_of(wall)], [True, False], [holes, 0], gap)


_BANDS: Final[dict[Layout, Callable[[int, Stream, int], _Band]]] = {
    "walls": _walls,
    "narrows": _narrows,
    "dead_ends": _dead_ends,
    "crossing": _crossing,
    "maze": _maze,
}

_BUSY_SHARE: Final[dict[Layout | None, float]] = {
    "walls": 0.4,
    "narrows": 0.3,
    "dead_ends": 0.45,
    "crossing": 0.75,
    "maze": 0.5,
}
"""Share of rows with movers, counted on many roads."""
