"""Where movers may be, whatever they do: sets of cells grown by one step in every tick.

A mover may go left, go right or keep its cell in every tick in which movers of its kind step, however it is
drawn who yields or brakes and whichever way it heads. What the rules of motion allow to nobody bounds it: it
stays in its row, enters no fixed hazard and no cell that another mover stands in, and passes nobody; a mover
that a hazard holds keeps its cell. The sets are exact for that: the union over all that movers may do.

Nobody passes anybody. So a mover is as far to the right as it can be if all movers go right whenever they can
(`_Fronts`), and likewise to the left. It may be in every cell between these two ends, and each end goes on by
at most one cell in a tick; so the sets are the union of the ends of all ticks so far. All of it is bit
operations on whole boards.

The idea is the occupancy of reachable sets in M. Althoff and J. M. Dolan, "Online verification of automated
road vehicles using reachability analysis", IEEE Transactions on Robotics 30(4), 2014.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm
from typing import Final, NamedTuple

from sim.perceive import Percept
from sim.rules.mover_boards import PERIODS
from sim.rules.traffic import steps_in_tick
from sim.types import MARKED, Kind
from sim.world.grid import Board, union


class Occupancy(NamedTuple):
    """What movers may do in one tick."""

    occupied: Board
    """cells that a mover may stand in after it"""
    came_right: Board
    """cells that a mover may enter in it by a step to the right (from column − 1)"""
    came_left: Board
    """cells that a mover may enter in it by a step to the left (from column + 1)"""


class _Fronts:
    """The movers, all as far to one side as they can be, by the number of ticks that a step takes them."""

    def __init__(self, groups: Sequence[Board], fixed: Board, last: Board, *, rightward: bool) -> None:
        """`groups`: movers by group; `last`: the cells of the last column to that side."""
        self.boards = list(groups)
        self._fixed = fixed
        self._last = last
        self._rightward = rightward

    def step(self, stepping: Sequence[bool]) -> list[Board]:
        """One tick on; returns the cells that were entered, by group."""
        boards, taken = self.boards, self._fixed | union(self.boards)
        entered = []
        for place, board in enumerate(boards):
            won = 0
            if stepping[place]:
                leaving = board ^ board & self._last
                want = leaving << 1 if self._rightward else leaving >> 1
                won = want ^ want & taken
                boards[place] = board ^ (won >> 1 if self._rightward else won << 1) | won
            entered.append(won)
        return entered


class ReachableSets:
    """`sets[k]`: what movers may do k ticks from now. Ticks are computed when they are first read."""

    def __init__(self, percept: Percept) -> None:
        """From what a percept shows; a proof takes one of the truth (`sim.perceive.perceive_truth`)."""
        road, boards = percept.road, percept.boards
        moving = (percept.right | percept.left) & ~boards.holding
        self._episode_tick = percept.episode_tick
        groups = _groups(moving, boards.marked)
        self._periods = tuple(groups)
        self._standing = percept.right | percept.left
        fixed = boards.fixed
        self._right = _Fronts(list(groups.values()), fixed, road.right_edge, rightward=True)
        self._left = _Fronts(list(groups.values()), fixed, road.left_edge, rightward=False)
        self._may_come_right = [0] * len(groups)
        self._may_come_left = [0] * len(groups)
        self._sets: list[Occupancy] = []
        self._idle = 0
        self.period: Final = lcm(*self._periods)
        """ticks after which every mover's steps fall on the same ticks again"""
        self.settled: int | None = None
        """the tick from which the sets repeat with that period, once it is known"""

    def __getitem__(self, ahead: int) -> Occupancy:
        if ahead < 0:
            raise IndexError("reachable sets begin with the coming tick")
        while len(self._sets) <= ahead:
            if self.settled is not None:
                return self._sets[self.settled + (ahead - self.settled) % self.period]
            self._sets.append(self._next())
        return self._sets[ahead]

    def _next(self) -> Occupancy:
        tick = self._episode_tick + len(self._sets)
        stepping = [steps_in_tick(period, tick) for period in self._periods]
        won_right, won_left = self._right.step(stepping), self._left.step(stepping)
        came_right = came_left = 0
        for place, steps in enumerate(stepping):
            if steps:
                self._may_come_right[place] |= won_right[place]
                self._may_come_left[place] |= won_left[place]
                came_right |= self._may_come_right[place]
                came_left |= self._may_come_left[place]
                # What is left by a step to one side may be entered again by one to the other.
                self._may_come_right[place] |= won_left[place] << 1
                self._may_come_left[place] |= won_right[place] >> 1
        won = union(won_right) | union(won_left)
        self._standing |= won
        self._idle = 0 if won else self._idle + 1
        if self._idle == self.period:
            # Nothing was won in all the phases: these are the last ticks that have to be kept.
            self.settled = len(self._sets) + 1 - self.period
        return Occupancy(self._standing, came_right, came_left)


def _groups(moving: Board, marked: Sequence[Board]) -> dict[int, Board]:
    """Movers by the number of ticks that they need for a cell."""
    groups = {PERIODS[Kind.VEHICLE]: moving ^ moving & union(marked)}
    for kind, board in zip(MARKED, marked, strict=True):
        groups[PERIODS[kind]] = groups.get(PERIODS[kind], 0) | moving & board
    return groups
