"""Notices that a vehicle is in a cycle: a situation repeats, and so everything after it repeats as well.

This holds where the future is certain and the planner decides from what the vehicle's own row and the one
ahead hold, besides what never moves (`local` in `sim.plan.protocol.Traits`). Movers keep to their rows and
the vehicle never goes back, so while it stays in its row nothing else has a part in what happens. A situation
is compared with one kept from before, which is renewed after 1, 2, 4, ... ticks, so that a cycle is found
within three times its length.
Source: Brent, "An improved Monte Carlo factorization algorithm" (BIT, 1980), section 2.
"""

from __future__ import annotations

from typing import NamedTuple

from sim.rules.kinds import common_period
from sim.types import MARKED
from sim.world import World
from sim.world.grid import Board


class Situation(NamedTuple):
    """What decides how it goes on: the boards hold the vehicle's row and the one ahead."""

    cell: int
    beat: int
    """`episode_tick` modulo the period in which the steps of all movers repeat"""
    right: Board
    left: Board
    marked: tuple[Board, ...]
    """the movers of each kind in `MARKED`"""


class Watch(NamedTuple):
    """A situation kept from before, and when it is renewed."""

    kept: Situation | None = None
    ticks: int = 0
    """since it was kept"""
    span: int = 1
    """ticks after which it is renewed"""


NOTHING_KEPT = Watch()
_NONE_MARKED = (0,) * len(MARKED)


def situation(world: World) -> Situation:
    """The situation of the first vehicle."""
    columns, cell = world.road.columns, world.avs[0]
    first = max(0, cell // columns - 1) * columns
    rows = (1 << 2 * columns) - 1
    boards = world.boards
    return Situation(
        cell,
        (world.tick - world.episode_start) % common_period(boards),
        world.right >> first & rows,
        world.left >> first & rows,
        tuple([board >> first & rows for board in boards.marked]) if boards.others else _NONE_MARKED,
    )


def update_watch(watch: Watch, world: World) -> Watch | None:
    """The watch with one more tick seen, at the end of which the world is this one; None if it repeats."""
    kept, ticks, span = watch
    now = situation(world)
    if kept is None:
        return Watch(now)
    if now == kept:
        return None
    columns = world.road.columns
    if now.cell // columns != kept.cell // columns:
        return Watch(now)
    ticks += 1
    return Watch(now, 0, 2 * span) if ticks == span else Watch(kept, ticks, span)
