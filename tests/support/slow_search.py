"""Searches that are slow and plain, over the twin of the rules: the oracle for what claims an optimum.

Sets and dictionaries, one state at a time; nothing of `sim.rules.traffic`, `sim.forecast` or `sim.search` is
used.
"""

from __future__ import annotations

from dataclasses import replace

from sim.search.costs import Weights
from sim.types import Cell, Move
from tests.support.twin import STEPS, Body, Position, braked_bodies, moved_bodies, will_be_free


class Future:
    """The bodies of a moment, rolled on by the twin, and where the vehicle may step.

    Nobody brakes; or, with `standing`, all do in the first tick, in which the vehicle stays.
    """

    def __init__(self, now: Position, *, standing: bool = False) -> None:
        self.now = now
        self.standing = standing
        self.limit = max(0, 10 * now.rows + 1 - now.episode_tick)
        self._moments = [now]

    def moment(self, ahead: int) -> Position:
        while len(self._moments) <= ahead:
            last = self._moments[-1]
            bodies = moved_bodies(last)
            if self.standing and len(self._moments) == 1:
                bodies = braked_bodies(last, bodies, {body.cell for body in last.bodies})
            self._moments.append(replace(last, bodies=bodies, episode_tick=last.episode_tick + 1))
        return self._moments[ahead]

    def bodies(self, ahead: int) -> tuple[Body, ...]:
        return self.moment(ahead).bodies

    def steps(self, ahead: int, cell: Cell) -> list[tuple[Move, Cell]]:
        """The moves that meet nothing, taken `ahead` ticks from now."""
        moment = replace(self.moment(ahead), av=cell)
        later = self.bodies(ahead + 1)
        found = []
        for move, (columns, rows) in STEPS.items():
            there = (cell[0] + columns, cell[1] + rows)
            if will_be_free(moment, later, there, attentive=()):
                found.append((move, there))
        return found


def least_ticks(now: Position) -> int | None:
    """Breadth-first over (tick, cell)."""
    future, cells = Future(now), {now.av}
    for ahead in range(future.limit + 1):
        if any(row == 0 for _, row in cells):
            return ahead
        if ahead == future.limit or not cells:
            return None
        cells = {there for cell in cells for _, there in future.steps(ahead, cell)}
    return None


def step_cost(future: Future, weights: Weights, ahead: int, move: Move, there: Cell) -> int:
    """What one step costs, from the definition."""
    charge = weights.tick
    if move in (Move.LEFT, Move.RIGHT):
        charge += weights.sideways
    elif move in (Move.FORWARD_LEFT, Move.FORWARD_RIGHT):
        charge += weights.diagonal
    elif move is Move.STAY:
        charge += weights.stay

    def distance(other: Cell) -> int:
        return max(abs(other[0] - there[0]), abs(other[1] - there[1]))

    if any(distance(hazard) == 1 for hazard in future.now.fixed):
        charge += weights.fixed
    for reach in range(1, weights.buffer + 1):
        if any(distance(body.cell) <= reach for body in future.bodies(ahead + 1)):
            charge += weights.mover
    return charge


def totals(now: Position, weights: Weights, horizon: int, *, braking: bool = True) -> dict[Move, int | None]:
    """What every move costs with the cheapest way on that ends within `horizon` ticks: the whole table.

    Where a mover brakes for a vehicle that stays, staying is looked at by itself.
    Without `braking` none does.
    """
    found = _table(Future(now), weights, horizon)
    standing = Future(now, standing=True)
    if braking and standing.bodies(1) != moved_bodies(now):
        found[Move.STAY] = _table(standing, weights, horizon)[Move.STAY]
    return found


def _table(future: Future, weights: Weights, horizon: int) -> dict[Move, int | None]:
    now = future.now
    horizon = min(horizon, future.limit)
    columns, rows = range(now.columns), range(now.av[1] + 1)
    rest: dict[Cell, int] = {(column, 0): 0 for column in columns}
    best: dict[Move, int | None] = dict.fromkeys(Move)
    for ahead in reversed(range(horizon)):
        before: dict[Cell, int] = {(column, 0): 0 for column in columns}
        for row in rows:
            for column in columns:
                cell = (column, row)
                if row == 0:
                    continue
                ways = {
                    move: step_cost(future, weights, ahead, move, there) + rest[there]
                    for move, there in future.steps(ahead, cell)
                    if there in rest
                }
                if ways:
                    before[cell] = min(ways.values())
                if ahead == 0 and cell == now.av:
                    best |= ways
        rest = before
    return best
