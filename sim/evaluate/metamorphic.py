"""Metamorphic relations of planners: what must hold between two drives whose roads differ in a known way.

No drive's result is known in advance; what is known is how two results relate (Chen, Cheung & Yiu,
"Metamorphic testing: a new approach for generating next test cases", 1998). A relation that does not hold is
a finding, told in words and with both roads, and not a broken promise: some planners break one and are useful
all the same.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final

from sim.config import Config
from sim.randomness import Stream
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Move, Outcome
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, bits, board_of
from sim.world.notation import write

RELATIONS: Final = {
    "mirror": "On the road seen in a mirror it arrives as well.",
    "pothole": "With one pothole more, away from its way, it arrives as well.",
    "unreachable": "A barrier behind it, which it can never reach, changes no move.",
    "sight": "Where it arrives with a camera in fog, it arrives when it sees the whole road.",
}
"""What each relation says."""
ROADS: Final = 60
AWAY: Final = 2
"""Columns between a pothole that is added and the cells that the drive takes in rows near it."""
_FOG: Final = {"sensor": "camera", "weather": "fog"}


@dataclass(frozen=True, slots=True)
class Finding:
    """A relation that does not hold on a road."""

    relation: str
    seed: int
    tick: int
    """the first tick at which the drives differ"""
    what: str
    """in words"""
    road: str
    """the road itself, and the other one where it differs (`sim.world.notation`)"""
    other: str


@dataclass(frozen=True, slots=True)
class Relation:
    """How often a relation was tried, and where it did not hold."""

    name: str
    tried: int
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True)
class Drive:
    """An episode: its states and the moves between them."""

    states: tuple[SimState, ...]
    moves: tuple[Move, ...]

    @property
    def arrived(self) -> bool:
        """Whether it reached the goal."""
        return self.states[-1].world.outcome is Outcome.SUCCESS

    @property
    def end(self) -> str:
        """How it ended, in words."""
        world = self.states[-1].world
        told = {Outcome.SUCCESS: "arrives", Outcome.CRASH: "crashes", Outcome.STUCK: "gets stuck"}
        return f"{told[world.outcome]} after {len(self.moves)} ticks"


def check_relations(
    planner: str, roads: int = ROADS, seconds: float = 60.0, tell: Callable[[str], None] | None = None
) -> tuple[Relation, ...]:
    """Try every relation on roads of the default kind, for at most about `seconds`."""
    until_s = time.monotonic() + seconds
    tried = dict.fromkeys(RELATIONS, 0)
    findings: dict[str, list[Finding]] = {name: [] for name in RELATIONS}
    for seed in range(roads):
        if time.monotonic() > until_s:
            break
        if tell is not None:
            tell(f"relations on road {seed}")
        for name, finding in _try_road(Config(seed=seed, planner=planner)):
            tried[name] += 1
            findings[name] += [] if finding is None else [finding]
    return tuple(Relation(name, tried[name], tuple(findings[name])) for name in RELATIONS)


def _try_road(config: Config) -> Iterator[tuple[str, Finding | None]]:
    """Each relation that can be tried on the road of a seed, with what was found."""
    start = SimState.start(config)
    drive = drive_of(start)
    yield "mirror", _mirror(drive)
    if (ways := _behind(drive)) is not None:
        yield "unreachable", ways[0]
    fog = drive_of(SimState.start(config.with_parts(**_FOG)))
    if fog.arrived:
        what = f"It arrives with a camera in fog, and when it sees the whole road it {drive.end}."
        yield "sight", None if drive.arrived else _finding("sight", fog, drive, what)
    if drive.arrived and (other := _with_pothole(drive)) is not None:
        yield "pothole", other[0]


def drive_of(start: SimState) -> Drive:
    """The episode that begins so."""
    states, moves = [start], []
    while states[-1].world.outcome is Outcome.RUNNING:
        done = step(states[-1])
        states.append(done.state)
        moves.append(Move.STAY if done.decision is None else done.decision.move)
    return Drive(tuple(states), tuple(moves))


def _mirror(drive: Drive) -> Finding | None:
    start = drive.states[0]
    other = drive_of(SimState.start(start.config, mirrored(start.world)))
    if other.arrived is drive.arrived:
        return None
    tick = _first_difference(drive.moves, [mirrored_move(move) for move in other.moves])
    what = f"It {drive.end}, and on the same road seen in a mirror it {other.end}: one side is preferred."
    return _finding("mirror", drive, other, what, tick)


def _with_pothole(drive: Drive) -> tuple[Finding | None] | None:
    """The relation with one pothole more; None where there is no place for one."""
    start = drive.states[0]
    cell = _away_from(drive)
    if cell is None:
        return None
    other = drive_of(SimState.start(start.config, _with_thing(start.world, Kind.POTHOLE, cell)))
    column, row = start.world.road.cell(cell)
    where = f"in lane {column + 1}, row {row}"
    what = f"It {drive.end}; with a pothole more {where}, away from its way, it {other.end}."
    return (None if other.arrived else _finding("pothole", drive, other, what),)


def _behind(drive: Drive) -> tuple[Finding | None] | None:
    """The relation with a barrier behind, midway; None where there is no place for one."""
    middle = len(drive.moves) // 2
    state = drive.states[middle]
    if state.world.outcome is not Outcome.RUNNING:
        return None
    world = state.world
    columns = world.road.columns
    first = (world.av // columns + 2) * columns
    busy = _rows_of_movers(world)
    free = [
        cell
        for cell in range(first, columns * world.road.rows)
        if not world.occupied >> cell & 1 and cell // columns not in busy
    ]
    if not free:
        return None
    cell = free[len(free) // 2]
    changed = replace(state, world=_with_thing(world, Kind.BARRIER, cell))
    moves = step(state).decision, step(changed).decision
    before, after = (None if each is None else each.move for each in moves)
    column, row = world.road.cell(cell)
    what = f"It moves {before}; with a barrier behind it in lane {column + 1}, row {row}, it moves {after}."
    if before is after:
        return (None,)
    return (Finding("unreachable", state.config.seed, middle, what, write(world), write(changed.world)),)


def _away_from(drive: Drive) -> int | None:
    """A free cell ahead, drawn by the seed, that the drive stays away from, in a row without movers."""
    world = drive.states[0].world
    road = world.road
    taken = {road.cell(state.world.av) for state in drive.states}
    busy = _rows_of_movers(world)
    free = [
        cell
        for cell in range(road.columns, world.av - world.av % road.columns)
        if not world.occupied >> cell & 1
        and cell // road.columns not in busy
        and all(
            abs(column - cell % road.columns) > AWAY
            for column, row in taken
            if abs(row - cell // road.columns) <= 1
        )
    ]
    return free[Stream.of(drive.states[0].config.seed, "metamorphic").below(len(free), 0)] if free else None


def _rows_of_movers(world: World) -> frozenset[int]:
    return frozenset(cell // world.road.columns for cell in world.movers)


def _with_thing(world: World, kind: Kind, cell: int) -> World:
    """The same world with one thing more."""
    boards = world.boards.with_kind(kind, world.board(kind) | 1 << cell)
    number = world.numbered.get(kind, 0) + 1
    return replace(
        world,
        boards=boards,
        hazards={**world.hazards, cell: f"{kind}-{number}"},
        numbered={**world.numbered, kind: number},
    )


def mirrored(world: World) -> World:
    """The same world seen in a mirror: left is right."""
    columns = world.road.columns

    def there(cell: int) -> int:
        return cell - cell % columns + columns - 1 - cell % columns

    def flipped(board: Board) -> Board:
        return board_of([there(cell) for cell in bits(board)])

    return replace(
        world,
        avs=tuple(map(there, world.avs)),
        right=flipped(world.left),
        left=flipped(world.right),
        boards=Boards.in_order([flipped(board) for board in world.boards.by_kind]),
        movers={there(cell): name for cell, name in world.movers.items()},
        hazards={there(cell): name for cell, name in world.hazards.items()},
    )


def mirrored_move(move: Move) -> Move:
    """The move to the other side."""
    name = move.value
    for one, other in (("left", "right"), ("right", "left")):
        if one in name:
            return Move(name.replace(one, other))
    return move


def _first_difference(one: tuple[Move, ...], other: list[Move]) -> int:
    pairs = enumerate(zip(one, other, strict=False))
    return next((tick for tick, (first, second) in pairs if first is not second), min(len(one), len(other)))


def _finding(relation: str, drive: Drive, other: Drive, what: str, tick: int | None = None) -> Finding:
    first = _first_difference(drive.moves, list(other.moves)) if tick is None else tick
    start, changed = drive.states[0], other.states[0]
    return Finding(relation, start.config.seed, first, what, write(start.world), write(changed.world))
