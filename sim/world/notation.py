"""Reads and writes a world as a few lines of text, for tests, logs and reports.

    road 8x30 tick 12 episode 1 from 0 running
    ..>.o...
    ...A....
    ids pothole 3, vehicle 7
    next pothole 5, vehicle 21

Cells: `.` empty, `A` the ego, `o` pothole, `#` barrier, `>` `<` obstacle vehicles by heading, `)` `(`
pedestrians; `}` `{` a vehicle disabled by a pothole, `]` `[` a pedestrian disabled by one (the signs of
`sim.types.KINDS`). `ids` gives the numbers of each kind in reading order, `next` the first unused number;
without them things are numbered 1, 2, 3 … An ego that shares its cell has a line of its own (`av 4,29`), and
so has the cause of a crash (`cause swap vehicle-7 at 4,12`, with ` by av-2` for another ego than the first).
An outcome other than `running` is followed by its tick (`crash at 12`).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from sim.types import HAZARDS, KINDS, MOVERS, PLACEABLE, Cell, Kind, Outcome, ego_id, kind_of
from sim.world import Cause, World
from sim.world.boards import BOARDED, Boards
from sim.world.grid import Board, Road, bits, board_of

MAX_CELLS = 64 * 512
"""Cells of the largest road that is read."""

_HEAD = re.compile(
    r"road (\d+)x(\d+) tick (\d+) episode (\d+) from (\d+) (running|success|crash|stuck)(?: at (\d+))?"
)
_CAUSE = re.compile(r"cause (hit|swap|cross) (\S+(?: \S+)*) at (\d+),(\d+)(?: by (av-\d+))?")


def _signs() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Every sign, and what is in its cell: kinds, and the heading of a mover."""
    yield ".", ()
    yield KINDS[Kind.AV].signs[0], (Kind.AV,)
    for kind in HAZARDS:
        yield KINDS[kind].signs[0], (kind,)
    holding = next(kind for kind in HAZARDS if KINDS[kind].holds_movers)
    for kind in MOVERS:
        right, left, *_ = KINDS[kind].signs
        yield right, ("right", kind)
        yield left, ("left", kind)
    for kind in MOVERS:
        *_, right, left = KINDS[kind].signs
        yield right, ("right", kind, holding)
        yield left, ("left", kind, holding)


_SIGNS: dict[str, tuple[str, ...]] = dict(_signs())
_SIGN_OF = {frozenset(parts): sign for sign, parts in _SIGNS.items()}


class NotationError(ValueError):
    """The text is not a world; the message names the line."""


def write(world: World) -> str:
    """Writes a world as text; `read` returns an equal world."""
    road = world.road
    shared = [cell for cell in world.avs if (world.fixed | world.moving) >> cell & 1]
    ended = "" if world.ended is None else f" at {world.ended}"
    lines = [
        f"road {road.columns}x{road.rows} tick {world.tick} episode {world.episode} "
        f"from {world.episode_start} {world.outcome}{ended}"
    ]
    alone = [cell for cell in world.avs if cell not in shared]
    boards: dict[str, Board] = {
        "right": world.right,
        "left": world.left,
        Kind.AV: board_of(alone),
        **{kind: world.board(kind) for kind in PLACEABLE},
    }
    for row in range(road.rows):
        cells = range(row * road.columns, (row + 1) * road.columns)
        lines.append("".join(_sign(boards, cell) for cell in cells))
    if shared or len(world.avs) != 1:
        lines.append("av " + " ".join(_point(road.cell(cell)) for cell in world.avs))
    if world.cause is not None:
        cause = world.cause
        by = "" if cause.ego == ego_id(0) else f" by {cause.ego}"
        lines.append(f"cause {cause.how} {' '.join(cause.ids)} at {_point(cause.cell)}{by}")
    ids = {kind: [world.id_at(cell, kind) for cell in bits(world.board(kind))] for kind in PLACEABLE}
    told = [
        f"{kind} {' '.join(name.rpartition('-')[2] for name in names)}"
        for kind, names in ids.items()
        if names
    ]
    if told:
        lines.append("ids " + ", ".join(told))
    if world.numbered:
        lines.append("next " + ", ".join(f"{kind} {last + 1}" for kind, last in world.numbered.items()))
    return "\n".join(lines) + "\n"


def read(text: str) -> World:
    """Reads a world from text. Raises `NotationError`."""
    lines = [line.strip() for line in text.strip().splitlines()]
    head = _HEAD.fullmatch(lines[0]) if lines else None
    if head is None:
        raise NotationError("line 1: expected 'road COLUMNSxROWS tick N episode N from N OUTCOME'")
    columns, rows, tick, episode, start = (int(head[n]) for n in range(1, 6))
    outcome, ended = Outcome(head[6]), None if head[7] is None else int(head[7])
    if not (columns and rows and columns * rows <= MAX_CELLS):
        raise NotationError(f"line 1: a road has 1 to {MAX_CELLS} cells")
    if start > tick or (ended or 0) > tick or (outcome is Outcome.RUNNING) is not (ended is None):
        raise NotationError("line 1: no tick is later than the present one; 'at' goes with an outcome")
    road = Road.of(columns, rows)
    boards = _read_grid(road, lines[1 : rows + 1])
    extra = _read_extra(lines[rows + 1 :], first=rows + 2)
    avs = _read_avs(road, extra.get("av"), boards[Kind.AV])
    movers, hazards, numbered = _read_ids({kind: boards[kind] for kind in PLACEABLE}, extra)
    return World(
        road=road,
        tick=tick,
        episode=episode,
        episode_start=start,
        outcome=outcome,
        ended=ended,
        cause=_read_cause(road, extra.get("cause")),
        avs=avs,
        right=boards["right"],
        left=boards["left"],
        boards=Boards.of({kind: boards[kind] for kind in BOARDED}),
        movers=movers,
        hazards=hazards,
        numbered=numbered,
    )


def _sign(boards: Mapping[str, Board], cell: int) -> str:
    return _SIGN_OF[frozenset(name for name, board in boards.items() if board >> cell & 1)]


def _point(cell: Cell) -> str:
    return f"{cell[0]},{cell[1]}"


def _read_grid(road: Road, lines: list[str]) -> dict[str, Board]:
    if len(lines) != road.rows:
        raise NotationError(f"expected {road.rows} rows of cells, found {len(lines)}")
    boards = dict.fromkeys(("right", "left", *Kind), 0)
    for row, line in enumerate(lines):
        if len(line) != road.columns or not set(line) <= set(_SIGNS):
            raise NotationError(f"line {row + 2}: expected {road.columns} of the signs {' '.join(_SIGNS)}")
        for column, sign in enumerate(line):
            for part in _SIGNS[sign]:
                boards[part] |= 1 << road.index((column, row))
    return boards


def _read_extra(lines: list[str], first: int) -> dict[str, str]:
    extra = {}
    for number, line in enumerate(lines, first):
        word, _, rest = line.partition(" ")
        if word not in ("av", "cause", "ids", "next") or word in extra:
            raise NotationError(f"line {number}: expected one each of 'av', 'cause', 'ids', 'next'")
        extra[word] = line if word == "cause" else rest
    return extra


def _read_avs(road: Road, told: str | None, board: Board) -> tuple[int, ...]:
    if told is None:
        avs = tuple(bits(board))
    else:
        avs = tuple(road.index(_read_point(road, point)) for point in told.split())
        if board and board != board_of(avs) & board:
            raise NotationError(f"'av {told}' leaves out a vehicle (A) of the grid")
    if not avs:
        raise NotationError("there is no autonomous vehicle (A) on the road")
    return avs


def _read_point(road: Road, point: str) -> Cell:
    match = re.fullmatch(r"(\d+),(\d+)", point)
    if match is None or not road.holds((int(match[1]), int(match[2]))):
        raise NotationError(f"'av {point}': expected a cell of the road like 4,29")
    return int(match[1]), int(match[2])


def _read_cause(road: Road, line: str | None) -> Cause | None:
    if line is None:
        return None
    match = _CAUSE.fullmatch(line)
    if match is None:
        raise NotationError(f"'{line}' is not like 'cause hit pothole-3 at 4,12'")
    ids, cell = tuple(match[2].split()), (int(match[3]), int(match[4]))
    try:
        kind = kind_of(ids[0])
    except ValueError as error:
        raise NotationError(f"'{line}': {ids[0]} is no id of a thing") from error
    if not road.holds(cell):
        raise NotationError(f"'{line}': {_point(cell)} is not on the road")
    return Cause(match[1], kind, ids, cell, match[5] or ego_id(0))


def _read_ids(
    by_kind: Mapping[Kind, Board], extra: Mapping[str, str]
) -> tuple[dict[int, str], dict[int, str], dict[Kind, int]]:
    told = _numbers(extra.get("ids"))
    following = _numbers(extra.get("next"))
    movers: dict[int, str] = {}
    hazards: dict[int, str] = {}
    numbered: dict[Kind, int] = {}
    for kind, board in by_kind.items():
        cells = list(bits(board))
        numbers = told.get(kind, list(range(1, len(cells) + 1)))
        if len(numbers) != len(cells):
            raise NotationError(f"'ids' names {len(numbers)} of kind {kind}, but the road has {len(cells)}")
        table = movers if kind.moves else hazards
        table.update({cell: f"{kind}-{number}" for cell, number in zip(cells, numbers, strict=True)})
        if len(set(numbers)) != len(numbers):
            raise NotationError(f"'ids' gives a number of kind {kind} twice")
        if kind in following:
            if len(following[kind]) != 1 or following[kind][0] <= max(numbers, default=0):
                raise NotationError(f"'next' needs one number of kind {kind}, above those given")
            numbered[kind] = following[kind][0] - 1
        elif numbers and "next" not in extra:
            numbered[kind] = max(numbers)
    return movers, hazards, numbered


def _numbers(told: str | None) -> dict[Kind, list[int]]:
    table = {}
    for part in (told or "").split(","):
        kind, *numbers = part.split() or [""]
        if not kind:
            continue
        try:
            table[Kind(kind)] = [int(number) for number in numbers]
        except ValueError as error:
            raise NotationError(f"'{part.strip()}' is not a kind with numbers") from error
    return table
