"""A slow, readable twin of one tick, written from the description of the world and nothing else.

It exists to disagree: `sim` does everything with boards of bits, this does it with one object per
thing and sets of cells, and shares only the names of moves, kinds and outcomes and the form worlds
come in. Left out on purpose: randomness (who is courteous is handed in), episodes after the first,
and more than one autonomous vehicle.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass, replace

from sim.kinds import Cell, Kind, Move, Outcome
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


@dataclass(frozen=True)
class Body:
    """One mover."""

    id: str
    cell: Cell
    heading: str
    walks: bool

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
        Body(thing.id, thing.cell, thing.heading, thing.kind is Kind.PEDESTRIAN)
        for thing in things
        if thing.heading is not None
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
    standing = {body.cell for body in now.bodies}
    planning = [
        body
        for body in now.bodies
        if body.cell not in now.potholes and (not body.walks or now.episode_tick % 2 == 1)
    ]

    def blocked(body: Body, wanted: Cell) -> bool:
        if not now.holds(wanted) or wanted in now.fixed or wanted in standing:
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


def will_be_free(now: Position, later: Collection[Body], cell: Cell) -> bool:
    """Whether the vehicle may be in a cell next, the movers' next cells being known."""
    if not now.holds(cell) or cell in now.fixed:
        return False
    if any(body.cell == cell for body in later):
        return False
    came_from = {body.id: body.cell for body in now.bodies}
    return not any(came_from[body.id] == cell and body.cell == now.av for body in later)


def priority_move(now: Position, later: Collection[Body]) -> Move:
    """Forward, then left, right, then the diagonals, then stay; staying if nothing is free."""
    for move, (columns, rows) in STEPS.items():
        if will_be_free(now, later, (now.av[0] + columns, now.av[1] + rows)):
            return move
    return Move.STAY


def step(now: Position, move: Move | None = None, courteous: Collection[Cell] = ()) -> tuple[Move, Position]:
    """One tick of a running episode: the move taken (the priority rule's unless one is given), and
    the moment after it."""
    later = moved_bodies(now, courteous)
    taken = priority_move(now, later) if move is None else move
    columns, rows = STEPS[taken]
    av = (now.av[0] + columns, now.av[1] + rows)
    after = replace(now, tick=now.tick + 1, episode_tick=now.episode_tick + 1, av=av, bodies=later)
    return taken, replace(after, outcome=judged(now, after))


def judged(before: Position, after: Position) -> Outcome:
    """How the moment after a tick stands."""
    came_from = {body.id: body.cell for body in before.bodies}
    together = any(body.cell == after.av for body in after.bodies)
    swapped = any(
        came_from[body.id] == after.av and body.cell == before.av and after.av != before.av
        for body in after.bodies
    )
    if after.av in after.fixed or together or swapped:
        return Outcome.CRASH
    if after.av[1] == 0:
        return Outcome.SUCCESS
    if after.episode_tick > 10 * after.rows:
        return Outcome.STUCK
    return Outcome.RUNNING
