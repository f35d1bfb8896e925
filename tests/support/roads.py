"""Roads for tests: written by hand, or drawn by hypothesis."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from sim.config import Config
from sim.state import SimState
from sim.types import KINDS, MOVERS, PLACEABLE, Kind
from sim.world import World, notation
from sim.world.boards import BOARDED, Boards
from sim.world.grid import Road, board_of


def road(*rows: str, tick: int = 0, lines: tuple[str, ...] = ()) -> World:
    """A world from its rows of signs."""
    head = f"road {len(rows[0])}x{len(rows)} tick {tick} episode 1 from 0 running"
    return notation.read("\n".join((head, *rows, *lines)))


def run_on(world: World, **parts: Any) -> SimState:
    """A run on a given road, with a configuration of its size.

    Unless a test says otherwise the rule of the source study drives, and nobody brakes.
    """
    config = Config(
        columns=world.road.columns,
        rows=world.road.rows,
        vehicles=0,
        potholes=0,
        planner="priority",
        attentive=0.0,
    )
    return SimState(config.with_parts(**parts), world)


def grid(world: World) -> list[str]:
    """The rows of signs of a world."""
    return notation.write(world).splitlines()[1 : world.road.rows + 1]


@st.composite
def worlds(draw: st.DrawFn, *, max_columns: int = 9, max_rows: int = 8) -> World:
    """Any world in which an episode may stand: movers of every kind, some held by potholes."""
    columns = draw(st.integers(3, max_columns))
    rows = draw(st.integers(4, max_rows))
    geometry = Road.of(columns, rows)
    av = draw(st.integers(columns, columns * rows - 1))
    signs = draw(
        st.lists(
            st.sampled_from("...." + "".join(sign for kind in PLACEABLE for sign in KINDS[kind].signs)),
            min_size=columns * rows,
            max_size=columns * rows,
        )
    )

    def cells(wanted: Collection[str]) -> int:
        return board_of([i for i, sign in enumerate(signs) if sign in wanted and i != av])

    movers = [KINDS[kind].signs for kind in MOVERS]
    boards = {kind: cells(KINDS[kind].signs) for kind in BOARDED}
    boards[Kind.POTHOLE] |= cells([sign for each in movers for sign in each[2:]])
    start = draw(st.integers(0, 500))
    bare = World(
        road=geometry,
        tick=start + draw(st.integers(0, 9 * rows)),
        episode=draw(st.integers(1, 9)),
        episode_start=start,
        avs=(av,),
        right=cells([sign for each in movers for sign in each[::2]]),
        left=cells([sign for each in movers for sign in each[1::2]]),
        boards=Boards.of(boards),
        movers={},
        hazards={},
        numbered={},
    )
    return numbered(bare)


def numbered(world: World) -> World:
    """The world with its things numbered 1, 2, 3 … in reading order."""
    tables: dict[bool, dict[int, str]] = {True: {}, False: {}}
    last = {}
    for kind in PLACEABLE:
        board, count = world.board(kind), 0
        for cell in range(world.road.columns * world.road.rows):
            if board >> cell & 1:
                count += 1
                tables[kind.moves][cell] = f"{kind}-{count}"
        if count:
            last[kind] = count
    return replace(world, movers=tables[True], hazards=tables[False], numbered=last)


def mirrored(world: World) -> World:
    """The mirror image of a world: column 0 becomes the last column; ids keep to their things."""
    columns = world.road.columns

    def cell(index: int) -> int:
        row, column = divmod(index, columns)
        return row * columns + columns - 1 - column

    def board(cells: int) -> int:
        return board_of([cell(i) for i in range(columns * world.road.rows) if cells >> i & 1])

    return replace(
        world,
        avs=tuple(cell(av) for av in world.avs),
        right=board(world.left),
        left=board(world.right),
        boards=Boards.in_order([board(cells) for cells in world.boards.by_kind]),
        movers={cell(index): name for index, name in world.movers.items()},
        hazards={cell(index): name for index, name in world.hazards.items()},
    )
