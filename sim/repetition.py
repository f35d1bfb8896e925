"""Detects cycles: once a situation repeats, everything after it repeats as well.

This holds where the future is certain and the planner decides from the ego's row, the row ahead and things
that never move (`local` in `sim.plan.protocol.Traits`). Movers keep to their rows and the ego never moves
backwards, so nothing else matters while the ego stays in its row. Each situation is compared with a stored
one, which is renewed after 1, 2, 4, ... ticks, so a cycle is detected within three times its length.
Source: Brent, "An improved Monte Carlo factorization algorithm" (BIT, 1980), section 2.
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from sim.rules.mover_boards import common_period
from sim.types import MARKED
from sim.world import World
from sim.world.grid import Board


class Situation(NamedTuple):
    """Everything that decides the future of a cycle: the boards hold the ego's row and the row ahead."""

    cell: int
    beat: int
    """`episode_tick` modulo the period in which the steps of all movers repeat"""
    right: Board
    left: Board
    marked: tuple[Board, ...]
    """the movers of each kind in `MARKED`"""


class Watch(NamedTuple):
    """A stored situation, and when it is renewed."""

    kept: Situation | None = None
    ticks: int = 0
    """ticks since it was stored"""
    span: int = 1
    """ticks after which it is renewed"""


NOTHING_KEPT = Watch()
_situation = partial(tuple.__new__, Situation)  # a third of the time that the classes' own take
_watch = partial(tuple.__new__, Watch)
_NONE_MARKED = (0,) * len(MARKED)


def situation(world: World) -> Situation:
    """Returns the situation of the first ego."""
    columns, cell = world.road.columns, world.avs[0]
    first = max(0, cell // columns - 1) * columns
    rows = (1 << 2 * columns) - 1
    boards = world.boards
    marked = tuple([board >> first & rows for board in boards.marked]) if boards.others else _NONE_MARKED
    beat = (world.tick - world.episode_start) % common_period(boards)
    return _situation((cell, beat, world.right >> first & rows, world.left >> first & rows, marked))


def update_watch(watch: Watch, world: World) -> Watch | None:
    """Returns the watch after a tick that ended in `world`; None if its situation is a repetition."""
    kept, ticks, span = watch
    now = situation(world)
    if kept is None:
        return _watch((now, 0, 1))
    if now == kept:
        return None
    columns = world.road.columns
    if now[0] // columns != kept[0] // columns:
        return _watch((now, 0, 1))
    ticks += 1
    return _watch((now, 0, 2 * span) if ticks == span else (kept, ticks, span))
