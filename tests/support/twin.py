"""A slow, readable twin of one tick, written from the description of the world and nothing else.

It exists to disagree: `sim` does everything with boards of bits, this does it with one object per
thing, sets of cells, and rectangles that glide, and shares only the names of moves, kinds and outcomes
and the form worlds come in. Left out on purpose: randomness (who is courteous and who is attentive is handed
in), episodes after the first, and more than one autonomous vehicle.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Hashable
from dataclasses import dataclass, field, replace
from fractions import Fraction

from sim.types import KINDS, Cell, Kind, Move, Outcome
from sim.world import World

SIDE = {"left": -1, "right": 1}
OTHER = {"left": "right", "right": "left"}
STEPS: dict[Move, Cell] = {
    Move.FORWARD: (0, -1),
    Move.LEFT: (-1, 0),
    Move.RIGHT: (1, 0),
    Move.FORWARD_LEFT: (-1, -1),
    Move.FORWARD_RIGHT: (1, -1),
    Move.STAY: (0, 0),
}
Size = tuple[Fraction, Fraction]
"""Across the road and along it, in cells."""
EGO: Size = (Fraction(32, 100), Fraction(66, 100))
SIZES: dict[Kind, Size] = {
    Kind.VEHICLE: (Fraction(66, 100), Fraction(32, 100)),
    Kind.PEDESTRIAN: (Fraction(30, 100), Fraction(32, 100)),
}
PERIODS: dict[Kind, int] = {Kind.VEHICLE: 1, Kind.PEDESTRIAN: 2}
"""Ticks for a cell. What the rules say of kinds that came later is read from their table."""


@dataclass(frozen=True)
class Body:
    """One mover."""

    id: str
    cell: Cell
    heading: str
    kind: Kind

    @property
    def walks(self) -> bool:
        return self.kind is Kind.PEDESTRIAN

    @property
    def size(self) -> Size:
        return SIZES.get(self.kind, KINDS[self.kind].size)

    @property
    def period(self) -> int:
        return PERIODS.get(self.kind, KINDS[self.kind].period or 1)

    def beside(self, heading: str) -> Cell:
        return (self.cell[0] + SIDE[heading], self.cell[1])


@dataclass(frozen=True)
class Position:
    """One moment of an episode."""

    columns: int
    rows: int
    tick: int
    episode_tick: int
    av: Cell
    potholes: frozenset[Cell]
    barriers: frozenset[Cell]
    bodies: tuple[Body, ...]
    outcome: Outcome = Outcome.RUNNING

    @property
    def fixed(self) -> frozenset[Cell]:
        return self.potholes | self.barriers

    def holds(self, cell: Cell) -> bool:
        return 0 <= cell[0] < self.columns and 0 <= cell[1] < self.rows


def position(world: World) -> Position:
    """The moment a world shows, by its list of things."""
    things = list(world.things())
    cells = {kind: frozenset(thing.cell for thing in things if thing.kind is kind) for kind in Kind}
    bodies = [
        Body(thing.id, thing.cell, thing.heading, thing.kind) for thing in things if thing.heading is not None
    ]
    return Position(
        columns=world.road.columns,
        rows=world.road.rows,
        tick=world.tick,
        episode_tick=world.tick - world.episode_start,
        av=world.road.cell(world.avs[0]),
        potholes=cells[Kind.POTHOLE],
        barriers=cells[Kind.BARRIER],
        bodies=tuple(sorted(bodies, key=lambda body: body.id)),
        outcome=world.outcome,
    )


def moved_bodies(now: Position, courteous: Collection[Cell] = ()) -> tuple[Body, ...]:
    """Where the movers of this moment will be, and facing which way. `courteous`: cells of movers
    that count the vehicle's cell as blocked."""
    status = {body.cell for body in now.bodies}
    planning = [
        body
        for body in now.bodies
        if body.cell not in now.potholes and now.episode_tick % body.period == body.period - 1
    ]

    def blocked(body: Body, wanted: Cell) -> bool:
        if not now.holds(wanted) or wanted in now.fixed or wanted in status:
            return True
        return body.cell in courteous and wanted == now.av

    def winners(bodies: list[Body], taken: set[Cell]) -> dict[str, Cell]:
        wishes = [(body, body.beside(body.heading)) for body in bodies]
        asked = Counter(cell for _, cell in wishes)
        return {
            body.id: cell
            for body, cell in wishes
            if asked[cell] == 1 and cell not in taken and not blocked(body, cell)
        }

    first = winners(planning, taken=set())
    turned = [replace(body, heading=OTHER[body.heading]) for body in planning if body.id not in first]
    second = winners(turned, taken=set(first.values()))

    facing = {body.id: body.heading for body in turned}
    won = first | second
    return tuple(
        replace(body, cell=won.get(body.id, body.cell), heading=facing.get(body.id, body.heading))
        for body in now.bodies
    )


def braked_bodies(now: Position, later: Collection[Body], attentive: Collection[Cell]) -> tuple[Body, ...]:
    """The same, where the vehicle stays: who would enter its cell and is attentive keeps its own cell, and
    faces the way it would have gone."""
    return tuple(
        replace(body, cell=before.cell)
        if body.cell == now.av != before.cell and before.cell in attentive
        else body
        for before, body in zip(now.bodies, later, strict=True)
    )


def together(one: tuple[Cell, Cell], one_size: Size, other: tuple[Cell, Cell], other_size: Size) -> bool:
    """Whether two rectangles that glide in one tick from the middle of a cell to the middle of another, each
    without speeding up, ever share a point that is on the edge of neither."""
    begin, end = Fraction(-1), Fraction(2)  # when they do; the tick lasts from 0 to 1
    for axis in (0, 1):
        room = (one_size[axis] + other_size[axis]) / 2
        apart = one[0][axis] - other[0][axis]
        speed = (one[1][axis] - one[0][axis]) - (other[1][axis] - other[0][axis])
        if speed == 0:
            if abs(apart) >= room:
                return False
            continue
        times = sorted(((-room - apart) / speed, (room - apart) / speed))
        begin, end = max(begin, times[0]), min(end, times[1])
    return begin < end and begin < 1 and end > 0


def crashes(now: Position, av: Cell, later: Collection[Body], *, swept: bool) -> bool:
    """Whether the vehicle, going to the cell `av` in this tick, collides. Not `swept`: cells alone count."""
    if av in now.fixed:
        return True
    for before, body in zip(now.bodies, later, strict=True):
        if max(abs(before.cell[0] - now.av[0]), abs(before.cell[1] - now.av[1])) > 2:
            continue  # in one tick they do not come together from so far
        if swept and together((now.av, av), EGO, (before.cell, body.cell), body.size):
            return True
        if not swept and (body.cell == av or (body.cell == now.av and before.cell == av)):
            return True
    return False


def outlook(
    now: Position,
    move: Move,
    moved: tuple[Body, ...],
    attentive: Collection[Cell] | None = None,
    *,
    swept: bool = True,
) -> tuple[Cell, tuple[Body, ...], bool]:
    """Where a move leads, where the movers are then, and whether it ends in no collision and on the road.

    `moved`: the movers if nobody brakes. `attentive`: cells of movers who do; None for all of them.
    """
    columns, rows = STEPS[move]
    av = (now.av[0] + columns, now.av[1] + rows)
    if move is Move.STAY:
        braking = {body.cell for body in now.bodies} if attentive is None else attentive
        moved = braked_bodies(now, moved, braking)
    return av, moved, now.holds(av) and not crashes(now, av, moved, swept=swept)


def will_be_free(
    now: Position, moved: tuple[Body, ...], cell: Cell, attentive: Collection[Cell] | None = None
) -> bool:
    """Whether the vehicle may be in a cell next, to itself or one that a move leads to; as `outlook`."""
    offset = (cell[0] - now.av[0], cell[1] - now.av[1])
    move = next(move for move, step in STEPS.items() if step == offset)
    return outlook(now, move, moved, attentive)[2]


def priority_move(
    now: Position,
    moved: tuple[Body, ...],
    attentive: Collection[Cell] | None = None,
    *,
    swept: bool = True,
) -> Move:
    """Forward, then left, right, then the diagonals, then stay; staying if nothing is free."""
    for move in STEPS:
        if outlook(now, move, moved, attentive, swept=swept)[2]:
            return move
    return Move.STAY


def step(
    now: Position,
    move: Move | None = None,
    courteous: Collection[Cell] = (),
    attentive: Collection[Cell] | None = None,
    *,
    swept: bool = True,
) -> tuple[Move, Position]:
    """One tick of a running episode: the move taken (the priority rule's unless one is given), and
    the moment after it."""
    moved = moved_bodies(now, courteous)
    taken = priority_move(now, moved, attentive, swept=swept) if move is None else move
    av, later, free = outlook(now, taken, moved, attentive, swept=swept)
    after = replace(now, tick=now.tick + 1, episode_tick=now.episode_tick + 1, av=av, bodies=later)
    return taken, replace(after, outcome=judged(after, free=free))


def judged(after: Position, *, free: bool) -> Outcome:
    """How the moment after a tick stands."""
    if not free:
        return Outcome.CRASH
    if after.av[1] == 0:
        return Outcome.SUCCESS
    if after.episode_tick > 10 * after.rows:
        return Outcome.STUCK
    return Outcome.RUNNING


@dataclass
class Memory:
    """Every situation since the vehicle came into its row, or since it was first left to the rule.

    A situation is what has a part in what comes: the vehicle's cell, whether pedestrians walk, and who is
    where and facing which way in its row and in the one ahead.
    """

    row: int = -1
    situations: list[Hashable] = field(default_factory=list)

    def noticed(self, now: Position) -> bool:
        """Remember this moment; whether it is seen to be like the one to compare with.

        That is the latest of number 0, 1, 3, 7, 15 and so on that lies before.
        """
        if now.av[1] != self.row:
            self.row, self.situations = now.av[1], []
        near = frozenset(
            (body.cell, body.heading, body.kind)
            for body in now.bodies
            if body.cell[1] in (now.av[1], now.av[1] - 1)
        )
        self.situations.append((now.av, now.episode_tick % 2, near))
        number = len(self.situations) - 1
        before = [2**power - 1 for power in range(number.bit_length() + 1) if 2**power - 1 < number]
        return bool(before) and self.situations[before[-1]] == self.situations[number]
