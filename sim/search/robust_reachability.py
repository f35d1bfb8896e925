"""Ways that nothing can hit, whatever the others do.

Structure: forward reachability as in `sim.search.reachability`, through the sets of cells where movers *may*
be (`sim.forecast.reachable_sets`) instead of those where they are expected. A way that is found is one fixed
sequence of moves, and it holds for every draw of courtesy and attention, and for movers that turn or stand
without reason. Other egos may make any move of theirs; this one keeps a cell away from wherever they may be.
Where moves may slip, only straight ones are relied upon, and a first move to the side counts as both.

Guarantee: sound, since the sets hold every outcome. Not complete: a vehicle that answers to what the others
do may keep clear where no fixed sequence of moves does.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from operator import or_
from typing import Final

from sim.forecast import Forecast, ReachableSets
from sim.rules.ego_step import Steps, beside
from sim.rules.slipping import STRAIGHT
from sim.types import MOVES, Move
from sim.world.grid import Board, Road

SURE_MOVES: Final = tuple(move for move in MOVES if move not in STRAIGHT)
"""The moves that never slip."""


@dataclass(frozen=True, slots=True)
class Guarantee:
    """For how long a way keeps clear of everything, whatever the others do."""

    ticks: int
    """ticks for which it was proved; where `to_the_end`, those that were looked at"""
    to_the_end: bool
    """whether it keeps clear to the end of the episode, or arrives"""
    arrives: int | None
    """ticks of the shortest such way to the goal; None where there is none"""

    @staticmethod
    def weaker(one: Guarantee, other: Guarantee) -> Guarantee:
        """What holds where it is unknown which of two comes true."""
        both = None not in (one.arrives, other.arrives)
        return Guarantee(
            min(one.ticks, other.ticks),
            one.to_the_end and other.to_the_end,
            max(one.arrives or 0, other.arrives or 0) if both else None,
        )


def guarantee(forecast: Forecast, limit: int, *, first: Move | None = None, slips: bool = False) -> Guarantee:
    """For how long the forecast's own vehicle can keep clear of everything for sure.

    `limit`: the ticks that the episode still has; `first`: the move that it begins with (None: any);
    `slips`: whether a step to the side may be lost.
    """
    search = _Search(forecast, limit, slips=slips)
    if first is None:
        return search.run(search.first_steps())
    found = search.run(search.first_step(first))
    if slips and first in STRAIGHT:
        return Guarantee.weaker(found, search.run(search.first_step(STRAIGHT[first])))
    return found


def movers_that_may_hit(forecast: Forecast, move: Move) -> tuple[str, ...]:
    """The movers that may hit the vehicle in its coming move if they do as they like, by cell."""
    end = forecast.dynamics.target(forecast.ego, move)
    if end is None:
        return ()
    coming = ReachableSets(forecast.percept)[0]
    cells, from_left, from_right = forecast.dynamics.swept(forecast.ego, end)
    found = set()
    movers = forecast.percept.movers
    for cell in cells:
        if coming.occupied >> cell & 1:
            found.add(cell)
        found |= {cell - 1} if coming.came_right >> cell & 1 else set()
        found |= {cell + 1} if coming.came_left >> cell & 1 else set()
    found |= {cell - 1 for cell in from_left if coming.came_right >> cell & 1}
    found |= {cell + 1 for cell in from_right if coming.came_left >> cell & 1}
    return tuple(movers[cell] for cell in sorted(found) if cell in movers)


class _Search:
    """Forward reachability of one vehicle among sets of cells that may be taken."""

    def __init__(self, forecast: Forecast, limit: int, *, slips: bool) -> None:
        self._forecast = forecast
        self._limit = limit
        self._slips = slips
        self._sets = ReachableSets(forecast.percept)
        self._others = [sum(1 << other.cell for other in forecast.egos)]
        """where other egos may be, by tick"""

    def first_steps(self) -> Board:
        """Where a vehicle may be after the coming tick for sure, by any move that can be relied upon."""
        steps = self._steps(1 << self._forecast.ego)
        return _union(steps, SURE_MOVES if self._slips else MOVES)

    def first_step(self, move: Move) -> Board:
        """Where it is after this move for sure; empty where it may be hit."""
        return self._steps(1 << self._forecast.ego)[MOVES.index(move)] if self._limit else 0

    def run(self, there: Board) -> Guarantee:
        """How long a vehicle in one of these cells after the coming tick can keep clear."""
        goal, period = self._forecast.road.row(0), self._sets.period
        layers: list[Board] = []
        for ticks in range(1, self._limit + 1):
            if not there:
                return Guarantee(ticks - 1, to_the_end=False, arrives=None)
            if there & goal:
                return Guarantee(ticks, to_the_end=True, arrives=ticks)
            layers.append(there)
            settled = self._sets.settled
            if settled is not None and ticks - period > settled and self._repeats(layers, period):
                return Guarantee(ticks, to_the_end=True, arrives=None)
            there = self._spread(there, ticks)
        return Guarantee(self._limit, to_the_end=True, arrives=None)

    def _repeats(self, layers: list[Board], period: int) -> bool:
        """Whether from here on the same layers come again and again."""
        others = self._others_after(len(layers))
        return layers[-1] == layers[-1 - period] and others == self._others[len(layers) - period]

    def _spread(self, start: Board, ahead: int) -> Board:
        """Every cell that is reached for sure by a move `ahead` ticks from now."""
        forecast, coming = self._forecast, self._sets[ahead]
        blocked = forecast.fixed | coming.occupied | self._near_others(ahead)
        if self._slips:
            steps = forecast.dynamics.steps(start, blocked, coming.came_right, coming.came_left)
            return _union(steps, SURE_MOVES)
        return forecast.dynamics.spread(start, blocked, coming.came_right, coming.came_left)

    def _steps(self, start: Board) -> Steps:
        """Where the moves of the coming tick lead for sure."""
        forecast, coming = self._forecast, self._sets[0]
        blocked = forecast.fixed | coming.occupied | self._near_others(0)
        steps = forecast.dynamics.steps(start, blocked, coming.came_right, coming.came_left)
        denied = [forecast.dynamics.denied(other.cell, move) for other in forecast.egos for move in MOVES]
        closed = [any(found[place].starts & start for found in denied) for place in range(len(MOVES))]
        return Steps(*(0 if shut else ends for shut, ends in zip(closed, steps, strict=True)))

    def _near_others(self, ahead: int) -> Board:
        """The cells in which another ego may be met that moved `ahead` ticks from now.

        Two egos that are two cells apart before and after a tick do not touch within it.
        """
        forecast = self._forecast
        if not forecast.egos:
            return 0
        if forecast.dynamics.rows_a_tick > 1:
            return forecast.road.all  # what longer steps meet is not derived here
        return _around(forecast.road, self._others_after(ahead + 1))

    def _others_after(self, ticks: int) -> Board:
        while len(self._others) <= ticks:
            before = self._others[-1]
            self._others.append(before | self._forecast.dynamics.ends_anywhere(before))
        return self._others[ticks]


def _around(road: Road, board: Board) -> Board:
    wide = beside(board, road.left_edge, road.right_edge)
    return (wide | wide << road.columns | wide >> road.columns) & road.all


def _union(steps: Steps, moves: tuple[Move, ...]) -> Board:
    return reduce(or_, (steps[MOVES.index(move)] for move in moves))
